#pragma once
// How many contacts are missed by looking at frames only, at every frame, every second, every fourth ... A
// contact goes from a beginning to an end, or is a touch; it is found if some frame looked at lies in it,
// ends included. Exact, as the times of contacts are: which of them lie at frames is known.

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "kds/event_log.h"
#include "structures/collision/pairs_asked.h"

namespace kds {

/// Hears of a run's events, of the structure `contacts` alone.
class SampledContacts final : public EventListener {
 public:
  /// Looked at are the frames 0, stride, 2 stride ... of the run.
  struct Sampling {
    std::size_t stride = 1;
    std::uint64_t contacts = 0, found = 0;
    [[nodiscard]] double missed() const {
      return contacts == 0 ? 0 : 1 - static_cast<double>(found) / static_cast<double>(contacts);
    }
  };

  explicit SampledContacts(std::span<const std::size_t> strides);

  /// Those in contact at the first frame; before any event.
  void add_built(std::span<const BeadPair> pairs);
  void on_event(const Event& event) override;
  /// Contacts that go on last until this frame, the run's last.
  void finish(std::size_t last_frame);

  [[nodiscard]] const std::vector<Sampling>& samplings() const { return samplings_; }

 private:
  void count(std::size_t first_frame, std::size_t last_frame);

  std::vector<Sampling> samplings_;
  std::map<BeadPair, std::size_t> since_;  // the first frame in a contact that goes on
};

}  // namespace kds
