#pragma once
// Records where along the chain, and at which depth of its tree, a structure changes.

#include <cstdint>
#include <string>
#include <vector>

#include "kds/event_log.h"
#include "motions/scene/scene.h"
#include "structures/necklace/necklace_tree.h"
#include "structures/session/session.h"

namespace kds {

/// The places of a structure's external events: along the chain, and by depth in its tree.
struct PlacesOfEvents {
  /// Number of events that name each bead. A node's event names the beads of its new basis. An event counts
  /// at each of its beads.
  std::vector<std::uint64_t> by_bead;
  /// Number of events at the nodes of each tree level, where roots have level 0. Empty if events do not occur
  /// at nodes.
  std::vector<std::uint64_t> by_level;
};

/// Listens to all events of a session.
class EventPlaces final : public EventListener {
 public:
  EventPlaces(const Session& session, const Scene& scene);
  void on_event(const Event& event) override;
  /// In the order of the session's structures.
  [[nodiscard]] const std::vector<PlacesOfEvents>& places() const { return places_; }

 private:
  NecklaceTree tree_;
  std::vector<std::size_t> levels_;  ///< levels of the tree's nodes
  std::vector<PlacesOfEvents> places_;
};

/// Returns "bead 54, N of ALA 59 in chain A", or "bead 54" if `name` is empty.
[[nodiscard]] std::string bead_text(std::size_t bead, const std::string& name);

}  // namespace kds
