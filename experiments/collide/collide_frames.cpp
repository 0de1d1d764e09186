#include "experiments/collide/collide_frames.h"

#include "experiments/run/load_scene.h"
#include "motions/scene/radii.h"

namespace kds {

CollideFrames::CollideFrames(const InputOptions& options, const std::function<void(const std::string&)>& warn)
    : frames_(open_frames(options, warn)) {
  const FrameSurvey survey = survey_frames(*frames_, options.radius == "auto", warn);
  radii_ = bead_radii(options.radius, frames_->necklaces(), survey);
  plane_ = survey.plane;
  frame_count_ = survey.frame_count;
  necklaces_ = bead_ranges(frames_->necklaces());
  bead_names_ = bead_names(frames_->necklaces());
}

bool CollideFrames::next(FrameRead& frame) {
  if (!frames_->next(frame)) return false;
  if (plane_) plane_->lay(frame.positions);
  return true;
}

}  // namespace kds
