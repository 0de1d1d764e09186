#include "experiments/events/event_distribution.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace kds {

std::size_t bin_width(std::size_t steps, std::size_t most) {
  return std::max<std::size_t>(1, (steps + most - 1) / most);
}

void EventCourse::add(std::uint64_t events, const FrameStamp& frame) {
  const std::uint64_t before = bins_.empty() ? 0 : bins_.back().cumulative;
  if (steps_ % width_ == 0) bins_.push_back({steps_, 0, frame, 0, 0});
  EventBin& bin = bins_.back();
  ++bin.steps;
  ++steps_;
  bin.events += events;
  bin.cumulative = before + events;
}

void Displacements::add_frame(Eigen::Matrix3Xd centers, const FrameStamp& stamp) {
  if (last_.cols() > 0) {
    if (steps_ % width_ == 0) bins_.push_back({last_stamp_, 0, 0, 0});
    Bin& bin = bins_.back();
    const Eigen::VectorXd moved = (centers - last_).colwise().norm();
    ++steps_;
    ++bin.steps;
    bin.sum_of_means += moved.mean();
    bin.most = std::max(bin.most, moved.maxCoeff());
  }
  last_ = std::move(centers);
  last_stamp_ = stamp;
}

EventGrid::EventGrid(const Scene& scene, std::size_t grids) {
  const double share = std::sqrt(std::min(1.0, 2.0 / static_cast<double>(grids)));
  const auto most = [share](std::size_t all) { return static_cast<std::size_t>(share * double(all)); };
  steps_per_bin = bin_width(scene.step_count(), std::max<std::size_t>(2, most(most_bins)));
  beads_per_block = bin_width(scene.bead_count(), std::max<std::size_t>(2, most(most_blocks)));
  for (std::size_t step = 0; step < scene.step_count(); step += steps_per_bin)
    edges.push_back(scene.stamp(step));
  counts.assign(edges.size(),
                std::vector<std::uint64_t>((scene.bead_count() + beads_per_block - 1) / beads_per_block));
  edges.push_back(scene.stamp(scene.step_count()));
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
    distribution.grid = EventGrid(scene, run.structures().size());
    for (const EventKind& kind : structure->kinds())
      for (const IdRole& role : kind.roles)
        if (role.of == IdRole::Of::node) distribution.by_level.resize(level_count, 0);
  }
}

void EventDistributions::on_event(const Event& event) {
  const EventKind& kind = event.kind;
  if (!kind.external || kind.counted_apart) return;
  EventDistribution& distribution = distributions_[event.structure_index];
  event.for_roles([&](const IdRole& role, std::span<const BeadId> ids) {
    if (role.of == IdRole::Of::node) {
      if (const auto node = tree_.find({ids.front(), ids.back()})) ++distribution.by_level[levels_[*node]];
    } else if (role.of == IdRole::Of::beads) {
      for (const BeadId bead : ids) {
        if (bead >= distribution.by_bead.size()) continue;
        ++distribution.by_bead[bead];
        ++distribution.grid
              .counts[event.step / distribution.grid.steps_per_bin][bead / distribution.grid.beads_per_block];
      }
    }
  });
}

std::string bead_text(std::size_t bead, const std::string& name) {
  return name.empty() ? fmt::format("bead {}", bead) : fmt::format("bead {}, {}", bead, name);
}

}  // namespace kds
