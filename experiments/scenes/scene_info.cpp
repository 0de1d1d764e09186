#include "experiments/scenes/scene_info.h"

#include <algorithm>
#include <cmath>

namespace kds {

namespace {

// Returns the necklace of a bead.
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
  Description(std::span<const Trajectory> necklaces, std::span<const std::size_t> frames_of_necklaces,
              std::span<const double> radii)
      : radii_(radii) {
    std::size_t beads = 0;
    for (std::size_t n = 0; n < necklaces.size(); ++n) {
      const Trajectory& necklace = necklaces[n];
      const auto first = static_cast<BeadId>(beads);
      beads += necklace.bead_count();
      info_.frames = std::max(info_.frames, frames_of_necklaces[n]);
      info_.necklaces.push_back({necklace.file,
                                 {first, static_cast<BeadId>(beads - 1)},
                                 frames_of_necklaces[n],
                                 {},
                                 {},
                                 necklace.breaks,
                                 necklace.later_breaks,
                                 necklace.residues,
                                 necklace.residues_read});
    }
    info_.beads = beads;
    info_.radius_min = *std::min_element(radii.begin(), radii.end());
    info_.radius_max = *std::max_element(radii.begin(), radii.end());
    for (const Condition condition : kConditions)
      info_.conditions[static_cast<std::size_t>(condition)].condition = condition;
  }

  [[nodiscard]] std::size_t frames() const { return info_.frames; }

  void add_frame(const FrameRead& frame, const ValidateOptions& options) {
    const bool first = begun_ == 0;
    ++begun_;
    std::vector<Necklace> necklaces;
    for (NecklaceInfo& info : info_.necklaces) {
      const Necklace& necklace = necklaces.emplace_back(info.beads, frame.positions, radii_);
      const Necklace::Extent bonds = necklace.bonds();
      if (first) info.radii = necklace.radii();
      if (first) info.bonds = bonds;
      info.bonds = {std::min(info.bonds.least, bonds.least), std::max(info.bonds.most, bonds.most)};
    }
    const NecklaceReport report = validate(necklaces, options);
    for (ConditionInfo& info : info_.conditions) {
      const Violations& violations = report[info.condition];
      if (violations.count == 0) continue;
      if (info.violations == 0) {
        info.first_frame = frame.stamp.number;
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
  std::span<const double> radii_;
  std::size_t begun_ = 0;  // number of frames begun
  SceneInfo info_;
};

}  // namespace

bool SceneInfo::proper() const {
  return std::all_of(conditions.begin(), conditions.end(), [](const auto& c) { return c.holds(); });
}

SceneInfo describe_frames(std::span<const Trajectory> necklaces,
                          std::span<const std::size_t> frames_of_necklaces, FrameSource& frames,
                          std::span<const double> radii, const ValidateOptions& options,
                          const std::function<void(std::size_t, std::size_t)>& progress) {
  Description description(necklaces, frames_of_necklaces, radii);
  FrameRead frame;
  for (std::size_t done = 0; frames.next(frame); progress(++done, description.frames()))
    description.add_frame(frame, options);
  return std::move(description).info();
}

SceneInfo describe_scene(std::span<const Trajectory> necklaces, std::span<const double> radii,
                         const ValidateOptions& options,
                         const std::function<void(std::size_t, std::size_t)>& progress) {
  MemoryFrames frames(necklaces);
  std::vector<std::size_t> frames_of_necklaces;
  for (const Trajectory& necklace : necklaces) frames_of_necklaces.push_back(necklace.frames.size());
  return describe_frames(necklaces, frames_of_necklaces, frames, radii, options, progress);
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
