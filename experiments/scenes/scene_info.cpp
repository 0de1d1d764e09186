#include "experiments/scenes/scene_info.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "motions/base/input_error.h"

namespace kds {

namespace {

// The necklace of a bead.
const Necklace& necklace_of(std::span<const Necklace> necklaces, BeadId bead) {
  return *std::find_if(necklaces.begin(), necklaces.end(),
                       [bead](const Necklace& necklace) { return bead <= necklace.beads().last; });
}

double distance_from_holding(std::span<const Necklace> necklaces, Condition condition,
                             const Violation& violation) {
  const auto [i, j] = violation;
  const Necklace& a = necklace_of(necklaces, i);
  const Necklace& b = necklace_of(necklaces, j);
  const auto bond = [&](BeadId bead) { return (a.center(bead + 1) - a.center(bead)).stableNorm(); };
  const double distance = (b.center(j) - a.center(i)).stableNorm();
  switch (condition) {
    case Condition::connected:
      return distance - (a.radius(i) + b.radius(j));
    case Condition::disjoint:
      return a.radius(i) + b.radius(j) - distance;
    case Condition::uncontained:
      return b.radius(j) - a.radius(i) - distance;
    case Condition::uniform_radii:
      return b.radius(j) / a.radius(i);
    case Condition::uniform_bonds:
      break;
  }
  return bond(j) / bond(i);
}

class Description {
 public:
  Description(std::span<const Trajectory> trajectories, std::span<const double> radii)
      : trajectories_(trajectories), radii_(radii) {
    std::size_t beads = 0;
    for (const Trajectory& t : trajectories) {
      if (longest_ == nullptr || t.frames.size() > longest_->frames.size()) longest_ = &t;
      const auto first = static_cast<BeadId>(beads);
      beads += t.bead_count();
      info_.necklaces.push_back({t.file,
                                 {first, static_cast<BeadId>(beads - 1)},
                                 t.frames.size(),
                                 {},
                                 {},
                                 t.breaks,
                                 t.residues,
                                 t.residues_read});
    }
    for (const Trajectory& t : trajectories)
      if (t.frames.size() != longest_->frames.size() && t.frames.size() != 1)
        throw InputError(fmt::format(
            "{}: {} frames, but {} has {}; necklaces of a scene need equal frame counts (or one frame: at "
            "rest)",
            t.file, t.frames.size(), longest_->file, longest_->frames.size()));
    info_.beads = beads;
    info_.frames = longest_->frames.size();
    info_.radius_min = *std::min_element(radii.begin(), radii.end());
    info_.radius_max = *std::max_element(radii.begin(), radii.end());
    for (const Condition condition : kConditions)
      info_.conditions[static_cast<std::size_t>(condition)].condition = condition;
    centers_.resize(3, static_cast<Eigen::Index>(beads));
  }

  [[nodiscard]] std::size_t frames() const { return info_.frames; }

  void add_frame(std::size_t frame, const ValidateOptions& options) {
    for (std::size_t n = 0; n < trajectories_.size(); ++n) {
      const auto& frames = trajectories_[n].frames;
      centers_.middleCols(info_.necklaces[n].beads.first, frames[0].cols()) =
          frames[frames.size() == 1 ? 0 : frame];
    }
    std::vector<Necklace> necklaces;
    for (NecklaceInfo& info : info_.necklaces) {
      const Necklace& necklace = necklaces.emplace_back(info.beads, centers_, radii_);
      const Necklace::Extent bonds = necklace.bonds();
      if (frame == 0) info.radii = necklace.radii();
      if (frame == 0) info.bonds = bonds;
      info.bonds = {std::min(info.bonds.least, bonds.least), std::max(info.bonds.most, bonds.most)};
    }
    const NecklaceReport report = validate(necklaces, options);
    for (ConditionInfo& info : info_.conditions) {
      const Violations& violations = report[info.condition];
      if (violations.count == 0) continue;
      if (info.violations == 0) {
        info.first_frame = longest_->frame_number(frame);
        info.first = violations.listed;
        for (const Violation& violation : info.first)
          info.by.push_back(distance_from_holding(necklaces, info.condition, violation));
      }
      info.violations += violations.count;
      ++info.frames;
    }
  }

  [[nodiscard]] SceneInfo info() && { return std::move(info_); }

 private:
  std::span<const Trajectory> trajectories_;
  std::span<const double> radii_;
  const Trajectory* longest_ = nullptr;
  Eigen::Matrix3Xd centers_;
  SceneInfo info_;
};

}  // namespace

bool SceneInfo::proper() const {
  return std::all_of(conditions.begin(), conditions.end(), [](const auto& c) { return c.holds(); });
}

SceneInfo describe_scene(std::span<const Trajectory> necklaces, std::span<const double> radii,
                         const ValidateOptions& options,
                         const std::function<void(std::size_t, std::size_t)>& progress) {
  Description description(necklaces, radii);
  for (std::size_t frame = 0; frame < description.frames(); ++frame) {
    description.add_frame(frame, options);
    progress(frame + 1, description.frames());
  }
  return std::move(description).info();
}

std::string_view about(Condition condition) {
  switch (condition) {
    case Condition::connected:
      return "consecutive beads touch";
    case Condition::disjoint:
      return "all others are disjoint";
    case Condition::uncontained:
      return "no bead lies in another";
    case Condition::uniform_radii:
      return "radii are uniform";
    case Condition::uniform_bonds:
      break;
  }
  return "bonds are uniform";
}

}  // namespace kds
