#pragma once
// The discrete-step adapter turns sampled frames into the motion of a step: it joins frames k and k+1 by a
// curve for each bead.
//
// The adapter reads frames from a FrameSource (motions/frames/frame_source.h). The adapter holds the window
// of frames that one step needs: two, or four for Hermite curves without velocities in the frames. Steps are
// fast to reach in ascending order. To go back, the source is read again from the start, or from anywhere if
// its frames are in memory.
//
// To add a way to join frames, add an enumerator to FrameMotion and its name, and extend degree(), reach()
// and coordinate().

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "motions/frames/frame_source.h"
#include "motions/scene/frame_survey.h"
#include "motions/scene/step_source.h"

namespace kds {

/// How beads move between sampled frames.
enum class FrameMotion {
  linear,
  /// Cubic Hermite curves. Velocities are those of the frames, or central differences over frames, one-sided
  /// at the first and last frame (FrameSurvey::velocities). With velocities of the frames the motion is
  /// continuously differentiable in time, with differences in numbers of frames, up to rounding.
  hermite,
  /// Linear, with weights such that each sphere moves on a straight line in lifted space (lifted_motion.h).
  lifted,
};
/// Names, in the order of the enumerators.
inline constexpr std::array<std::string_view, 3> frame_motion_names{"linear", "hermite", "lifted"};
[[nodiscard]] constexpr std::string_view name_of(FrameMotion motion) {
  return frame_motion_names[static_cast<std::size_t>(motion)];
}

class DiscreteStepAdapter final : public StepSource {
 public:
  /// Adapts frames that have been surveyed. `survey` must be that of the source, or of a source with the same
  /// frames. If the survey found a plane, the motion is two-dimensional. A source that is open has a survey
  /// of its first frame (LiveFrames::survey).
  DiscreteStepAdapter(std::unique_ptr<FrameSource> frames, const FrameSurvey& survey, FrameMotion motion);
  /// Adapts frames that are still to come. These frames have `dimension` coordinates, and all of them a cell
  /// if they are `periodic`.
  DiscreteStepAdapter(std::unique_ptr<FrameSource> frames, int dimension, FrameMotion motion, bool periodic);

  [[nodiscard]] int dimension() const override { return dimension_; }
  [[nodiscard]] int degree() const override { return motion_ == FrameMotion::hermite ? 3 : 1; }
  [[nodiscard]] bool is_lifted() const override { return motion_ == FrameMotion::lifted; }
  [[nodiscard]] std::size_t frame_count() const override { return frame_count_; }
  [[nodiscard]] std::optional<VelocitySource> velocities() const override;
  /// While frames may be added, a step that needs `reach` is known one frame later than others.
  [[nodiscard]] std::size_t known_steps() const override;

  [[nodiscard]] bool has_step(std::size_t k) override;
  void read_on() override;
  [[nodiscard]] FrameBuffer* buffer() override;
  [[nodiscard]] std::size_t reach() const override {
    return motion_ == FrameMotion::hermite && !velocities_ ? 1 : 0;
  }
  [[nodiscard]] std::unique_ptr<StepSource> over(std::unique_ptr<FrameSource> frames) const override;
  /// Throws InputError if the frame is gone, like go_to().
  [[nodiscard]] FrameStamp stamp(std::size_t frame) override;
  [[nodiscard]] Eigen::Matrix3Xd centers(std::size_t frame) override;

  void go_to(std::size_t k) override;
  [[nodiscard]] double coordinate(BeadId bead, int k, int axis) const override;
  [[nodiscard]] std::optional<LinearEnds> ends() const override;
  [[nodiscard]] std::optional<CellEnds> cells() const override;
  [[nodiscard]] Eigen::Vector3d mean_displacement() const override;

 private:
  /// An adapter of the same frames, which come from another source.
  DiscreteStepAdapter(std::unique_ptr<FrameSource> frames, const DiscreteStepAdapter& like);
  /// Reads frames until these are in the window.
  void hold(std::size_t first, std::size_t last);
  /// Reads the next frame into the window, in place of the oldest one if the window is full. Returns false if
  /// the source has no frame.
  [[nodiscard]] bool read_next();
  /// Like `read_next`, and counts the frame.
  [[nodiscard]] bool read_new();
  /// Returns a frame in the window.
  [[nodiscard]] const FrameRead& held(std::size_t frame) const { return window_[frame - first_held_]; }
  [[nodiscard]] double position(std::size_t frame, BeadId bead, int axis) const {
    return held(frame).positions(axis, static_cast<Eigen::Index>(bead));
  }
  /// Returns a third of a bead's velocity at an end of the present step, per step.
  [[nodiscard]] double third_of_velocity(std::size_t frame, BeadId bead, int axis) const;

  std::unique_ptr<FrameSource> source_;
  FrameBuffer* buffer_ = nullptr;  ///< the source, once frames are read ahead
  FrameMotion motion_;
  bool velocities_ = false;         ///< Hermite curves have the velocities of the frames
  std::optional<AxisPlane> plane_;  ///< none: frames are taken as they are
  bool periodic_ = false;           ///< FrameSurvey::periodic
  int dimension_;
  std::size_t beads_;
  std::size_t frame_count_ = 0;
  FrameStamp first_, last_;        ///< the first and last of all frames
  std::vector<FrameRead> window_;  ///< consecutive frames
  FrameRead spare_;                ///< memory for the next frame
  std::size_t first_held_ = 0;     ///< the first frame in the window
  std::size_t step_ = 0;           ///< the present step
};

}  // namespace kds
