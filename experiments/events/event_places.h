#pragma once
// Where along the chain, and how deep in its tree, structures change.

#include <cstdint>
#include <string>
#include <vector>

#include "kds/event_log.h"
#include "motions/scene/scene.h"
#include "structures/necklace/necklace_tree.h"
#include "structures/session/session.h"

namespace kds {

/// Where along the chain, and how deep in its tree, a structure changes: its external events.
struct PlacesOfEvents {
  /// That name this bead: of nodes, in the basis that is new. An event counts at each of its beads.
  std::vector<std::uint64_t> by_bead;
  /// At nodes of this level of the tree, roots 0; empty where events are not at nodes.
  std::vector<std::uint64_t> by_level;
};

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

/// "bead 54, N of ALA 59 in chain A", or "bead 54" where `name` is empty.
[[nodiscard]] std::string bead_text(std::size_t bead, const std::string& name);

}  // namespace kds
