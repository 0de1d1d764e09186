#pragma once
// Where along the chain, and how deep in its tree, structures change.

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "experiments/run/run_report.h"
#include "kds/event_log.h"
#include "motions/scene/scene.h"
#include "structures/necklace/necklace_tree.h"
#include "structures/session/session.h"

namespace kds {

/// Hears of all events of a session.
class EventPlaces final : public EventListener {
 public:
  EventPlaces(const Session& session, const Scene& scene);
  void on_event(const Event& event) override;
  /// In the order of the session's structures.
  [[nodiscard]] const std::vector<PlacesOfEvents>& places() const { return places_; }

 private:
  NecklaceTree tree_;
  std::vector<std::size_t> levels_;  ///< of its nodes
  std::vector<PlacesOfEvents> places_;
};

/// Bead, and events that name it; of long chains the first of some beads, and their mean.
[[nodiscard]] std::vector<std::pair<double, double>> means_along_chain(
    std::span<const std::uint64_t> by_bead);

}  // namespace kds
