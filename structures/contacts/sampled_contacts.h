#pragma once
// Counts the contacts that are missed if only frames are examined: every frame, every second, every fourth
// and so on. A contact lasts from a beginning to an end, or is a touch. A contact is found if an examined
// frame lies in it, ends included. Times of contacts are exact, so it is known which of them lie at frames.

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "kds/event_log.h"
#include "structures/necklace/bead_pairs.h"

namespace kds {

/// Listens to a run's events of the structure `contacts`.
class SampledContacts final : public EventListener {
 public:
  /// Examines the frames 0, stride, 2 stride ... of the run.
  struct Sampling {
    std::size_t stride = 1;
    std::uint64_t contacts = 0, found = 0;
    [[nodiscard]] double missed() const {
      return contacts == 0 ? 0 : 1 - static_cast<double>(found) / static_cast<double>(contacts);
    }
  };

  explicit SampledContacts(std::span<const std::size_t> strides);

  /// Adds the pairs in contact at the first frame. Must come before any event.
  void add_built(std::span<const BeadPair> pairs);
  void on_event(const Event& event) override;
  /// Ends all open contacts at this frame, the last of the run.
  void finish(std::size_t last_frame);

  [[nodiscard]] const std::vector<Sampling>& samplings() const { return samplings_; }

 private:
  void count(std::size_t first_frame, std::size_t last_frame);

  std::vector<Sampling> samplings_;
  std::map<BeadPair, std::size_t> since_;  // first frame of each open contact
};

}  // namespace kds
