#include "experiments/events/event_places.h"

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

std::vector<std::pair<double, double>> means_along_chain(std::span<const std::uint64_t> by_bead) {
  constexpr std::size_t most_points = 600;  // a plot is about as many pixels wide
  const std::size_t width = std::max<std::size_t>(1, (by_bead.size() + most_points - 1) / most_points);
  std::vector<std::pair<double, double>> points;
  for (std::size_t first = 0; first < by_bead.size(); first += width) {
    const auto some = by_bead.subspan(first, std::min(width, by_bead.size() - first));
    std::uint64_t sum = 0;
    for (const std::uint64_t count : some) sum += count;
    points.emplace_back(static_cast<double>(first),
                        static_cast<double>(sum) / static_cast<double>(some.size()));
  }
  return points;
}

}  // namespace kds
