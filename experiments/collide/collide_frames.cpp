#include "experiments/collide/collide_frames.h"

#include <algorithm>

#include "experiments/run/load_scene.h"
#include "motions/scene/radii.h"

namespace kds {

CollideFrames::CollideFrames(const InputOptions& options, const std::function<void(const std::string&)>& warn)
    : stream_(open_frames(options, warn)) {
  const SceneSurvey survey = stream_.survey(options.radius == "auto", warn);
  radii_ = bead_radii(options.radius, survey.necklaces, survey.bonds);
  plane_ = survey.plane;
  frame_count_ = survey.frame_count;
  BeadId first = 0;
  for (const Trajectory& necklace : survey.necklaces) {
    const auto beads = static_cast<BeadId>(necklace.bead_count());
    necklaces_.push_back({first, first + beads - 1});
    if (!necklace.bead_names.empty()) {
      bead_names_.resize(radii_.size());
      std::copy(necklace.bead_names.begin(), necklace.bead_names.end(), bead_names_.begin() + first);
    }
    first += beads;
  }
}

bool CollideFrames::next(FrameRead& frame) {
  if (!stream_.next(frame)) return false;
  if (!plane_) return true;
  frame.positions = frame.positions(plane_->axes, Eigen::all).eval();
  frame.positions.row(2).setZero();
  return true;
}

}  // namespace kds
