#include "experiments/events/event_places.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>

namespace kds {

EventPlaces::EventPlaces(const Session& session, const Scene& scene)
    : tree_(scene.necklaces()), levels_(tree_.node_count(), 0) {
  std::size_t level_count = 0;
  for (NodeId node = 0; node < tree_.node_count(); ++node) {
    for (const NodeId child : {tree_.left(node), tree_.right(node)})
      if (child != NecklaceTree::leaf) levels_[child] = levels_[node] + 1;
    level_count = std::max(level_count, levels_[node] + 1);
  }
  for (const KineticStructure* structure : session.structures()) {
    PlacesOfEvents& places = places_.emplace_back();
    places.by_bead.resize(scene.bead_count(), 0);
    for (const EventKind& kind : structure->kinds())
      for (const IdRole& role : kind.roles)
        if (role.of == IdRole::Of::node) places.by_level.resize(level_count, 0);
  }
}

void EventPlaces::on_event(const Event& event) {
  const EventKind& kind = event.kind;
  if (!kind.external || kind.counted_apart) return;
  PlacesOfEvents& places = places_[event.structure_index];
  event.for_roles([&](const IdRole& role, std::span<const BeadId> ids) {
    if (role.of == IdRole::Of::node) {
      if (const auto node = tree_.find({ids.front(), ids.back()})) ++places.by_level[levels_[*node]];
    } else {
      for (const BeadId bead : ids)
        if (bead < places.by_bead.size()) ++places.by_bead[bead];
    }
  });
}

std::string bead_text(std::size_t bead, const std::string& name) {
  return name.empty() ? fmt::format("bead {}", bead) : fmt::format("bead {}, {}", bead, name);
}

}  // namespace kds
