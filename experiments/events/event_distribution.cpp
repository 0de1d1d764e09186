#include "experiments/events/event_distribution.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <utility>

namespace kds {

std::size_t bin_width(std::size_t steps, std::size_t most) {
  return std::max<std::size_t>(1, (steps + most - 1) / most);
}

void EventCourse::add(std::uint64_t events, const FrameStamp& frame) {
  if (steps_ == most_bins * width_) {
    width_ *= 2;
    for (std::size_t bin = 0; bin < most_bins / 2; ++bin)
      bins_[bin] = {bins_[2 * bin].first_frame, bins_[2 * bin].events + bins_[2 * bin + 1].events};
    bins_.resize(most_bins / 2);
  }
  if (steps_ % width_ == 0) bins_.push_back({frame, 0});
  EventBin& bin = bins_.back();
  ++steps_;
  bin.events += events;
}

Json over_time_json(const EventCourse& course) {
  Json events = Json::array(), frames = Json::array(), picoseconds = Json::array();
  for (const EventBin& bin : course.bins()) {
    events.push_back(bin.events);
    frames.push_back(bin.first_frame.number);
    picoseconds.push_back(bin.first_frame.picoseconds);
  }
  Json json{{"steps", course.width()}, {"events", events}, {"frames", frames}};
  if (!course.bins().empty() && course.bins().front().first_frame.picoseconds)
    json["picoseconds"] = std::move(picoseconds);
  return json;
}

EventDistributions::EventDistributions(const KineticRun& run, const Scene& scene)
    : tree_(scene.necklaces()), levels_(tree_.node_count(), 0) {
  std::size_t level_count = 0;
  for (NodeId node = 0; node < tree_.node_count(); ++node) {
    for (const NodeId child : {tree_.left(node), tree_.right(node)})
      if (child != NecklaceTree::leaf) levels_[child] = levels_[node] + 1;
    level_count = std::max(level_count, levels_[node] + 1);
  }
  for (const KineticStructure* structure : run.structures()) {
    EventDistribution& distribution = distributions_.emplace_back();
    distribution.by_bead.resize(scene.bead_count(), 0);
    for (const EventKind& kind : structure->kinds())
      for (const IdRole& role : kind.roles)
        if (role.of == IdRole::Of::node) distribution.by_level.resize(level_count, 0);
  }
}

void EventDistributions::on_event(const Event& event) {
  const EventKind& kind = event.kind;
  if (!kind.external || kind.counted_apart) return;
  EventDistribution& distribution = distributions_[event.structure_index];
  named_.clear();
  event.for_roles([&](const IdRole& role, std::span<const BeadId> ids) {
    if (role.of == IdRole::Of::node) {
      if (const auto node = tree_.find({ids.front(), ids.back()})) ++distribution.by_level[levels_[*node]];
    } else if (role.of == IdRole::Of::beads) {
      named_.insert(named_.end(), ids.begin(), ids.end());
    }
  });
  // The pairs before and after a replacement may share a bead.
  std::ranges::sort(named_);
  const auto repeated = std::ranges::unique(named_);
  named_.erase(repeated.begin(), repeated.end());
  for (const BeadId bead : named_)
    if (bead < distribution.by_bead.size()) ++distribution.by_bead[bead];
}

std::string bead_text(std::size_t bead, const std::string& name) {
  return name.empty() ? fmt::format("bead {}", bead) : fmt::format("bead {}, {}", bead, name);
}

}  // namespace kds
