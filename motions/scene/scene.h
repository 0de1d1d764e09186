#pragma once
// All beads of a run on one clock: sampled frames become motion steps (the discrete-step adapter), or an
// instance file gives one step by itself. Beads are numbered necklace after necklace.

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "motions/base/bead_range.h"
#include "motions/base/require_index.h"
#include "motions/curves/bezier_motion.h"
#include "motions/curves/lifted_motion.h"
#include "motions/frames/trajectory.h"
#include "motions/readers/instance.h"
#include "motions/scene/scene_stream.h"

namespace kds {

/// How beads move between sampled frames.
enum class FrameMotion {
  linear,
  /// Cubic, with velocities by central differences over frames, one-sided at the first and last: continuously
  /// differentiable over frames up to rounding.
  hermite,
  /// Linear, with weights such that each sphere moves on a straight line in lifted space (lifted_motion.h).
  lifted,
};
/// In the order of the enumerators.
inline constexpr std::array<std::string_view, 3> frame_motion_names{"linear", "hermite", "lifted"};
[[nodiscard]] constexpr std::string_view name_of(FrameMotion motion) {
  return frame_motion_names[static_cast<std::size_t>(motion)];
}

/// What is known of a scene before its first frame comes.
struct PushedFrames {
  int dimension = 3;                        ///< 1 to 3
  std::vector<std::size_t> necklaces = {};  ///< how many beads each has
  std::vector<double> radii = {};           ///< one a bead, or one for all; none: points
  FrameMotion motion = FrameMotion::linear;
};

class Scene {
 public:
  /// Necklaces of equal frame counts; one of a single frame is at rest. `radii`: one a bead in scene order.
  /// Throws InputError where the counts differ, and where a number has no exact value (NaN, infinities).
  /// Where all beads keep to one plane x, y or z = constant in all frames, the scene is planar:
  /// two-dimensional, in that plane's coordinates (from four beads on, as fewer always keep to some plane).
  Scene(std::span<const Trajectory> necklaces, std::vector<double> radii,
        FrameMotion motion = FrameMotion::linear);
  /// The same of files, read frame by frame: in memory are those that the motion of one step needs, two, or
  /// four for Hermite curves. Steps are quick to load, and frames to look at, in their order; going back
  /// begins again with the first. `survey` is the stream's.
  Scene(std::unique_ptr<SceneStream> frames, const SceneSurvey& survey, std::vector<double> radii,
        FrameMotion motion = FrameMotion::linear);
  /// Points, or balls of these radii where they are given, one a point. Throws InputError likewise.
  explicit Scene(Instance instance, std::vector<double> radii = {});
  /// Frames are pushed one by one, and in memory are those of the last of the steps that they make. Throws
  /// InputError where there are no beads, or a radius or the dimension is none.
  explicit Scene(PushedFrames frames);

  /// The next frame: the coordinates of bead 0, then those of bead 1, `dimension` numbers each. Throws
  /// InputError, and the frame is not taken, where they are not so many, or not finite; std::logic_error
  /// where the scene has frames of its own or has ended.
  void push(std::span<const double> coordinates, std::optional<double> picoseconds = std::nullopt);
  /// No frame follows.
  void end_frames() { ended_ = true; }
  /// Steps whose motion is known: all, but of frames that are pushed. Between these Hermite curves are known
  /// one frame later, or when they end.
  [[nodiscard]] std::size_t known_steps() const;

  [[nodiscard]] int dimension() const { return dimension_; }
  [[nodiscard]] int degree() const { return degree_; }
  [[nodiscard]] bool is_lifted() const { return is_lifted_; }
  [[nodiscard]] std::size_t bead_count() const { return radii_.size(); }
  /// An instance has two: u = 0 and u = 1. Of frames that are pushed, those that came.
  [[nodiscard]] std::size_t frame_count() const { return frame_count_; }
  [[nodiscard]] std::size_t step_count() const { return frame_count_ == 0 ? 0 : frame_count_ - 1; }

  // An index of a frame, step or bead that is too large throws std::invalid_argument, which says how many
  // there are.

  /// A frame's number in the file and its time, for messages and results.
  [[nodiscard]] FrameStamp stamp(std::size_t frame) const;
  [[nodiscard]] std::size_t frame_number(std::size_t frame) const { return stamp(frame).number; }
  [[nodiscard]] const std::vector<BeadRange>& necklaces() const { return necklaces_; }
  /// As files name beads, "CA of ALA 12 in chain A"; empty where they do not.
  [[nodiscard]] const std::string& bead_name(BeadId bead) const {
    static const std::string unnamed;
    require_index("bead", bead, bead_count());
    return bead < bead_names_.size() ? bead_names_[bead] : unnamed;
  }
  [[nodiscard]] const std::vector<double>& radii() const { return radii_; }
  [[nodiscard]] bool equal_radii() const;
  /// Whether any bead has a name.
  [[nodiscard]] bool names_beads() const { return !bead_names_.empty(); }
  /// Those of an instance file have weights at most.
  [[nodiscard]] bool has_radii() const { return has_radii_; }
  /// For what compares weights: throws InputError where a weight, a radius squared, is too small a number to
  /// be right, unless all are the same.
  void require_weights() const;

  /// Sets the motion of step k, between frames k and k+1. Both frames are met exactly, whatever the kind of
  /// motion. Radii do not change during a step; the points of an instance have none, only weights.
  template <Motion M>
  void load(std::size_t step, M& motion) const {
    require_index("step", step, step_count());
    hold_for_step(step);
    if (M::degree != 1 || !is_sampled()) {
      for (BeadId b = 0; b < bead_count(); ++b) {
        for (int k = 0; k <= degree_; ++k) set_control_point(step, b, k, motion);
      }
    } else if constexpr (M::degree == 1) {
      motion.set_ends(frame(step).data(), frame(step + 1).data(), radii_.data());
    }
    if constexpr (lifted<M>) motion.set_drift(drift<M>(step));
  }
  /// Centres and weights at a frame; from the dimension on coordinates are zero.
  [[nodiscard]] Eigen::Matrix3Xd centers(std::size_t frame) const;
  [[nodiscard]] std::vector<double> weights(std::size_t frame) const;
  /// Where a point of a planar scene is in the input's coordinates; others are there.
  [[nodiscard]] Eigen::Vector3d in_input(const Eigen::Vector3d& point) const;

 private:
  [[nodiscard]] bool is_sampled() const { return !instance_; }
  void begin(FrameMotion motion, const std::vector<std::size_t>& bead_counts, const std::string& longest);
  void set_necklaces(const std::vector<std::size_t>& bead_counts);
  void name_beads(std::span<const Trajectory> necklaces);
  void lay_in_plane(const std::optional<AxisPlane>& plane);
  void lay_in_plane(Eigen::Matrix3Xd& frame) const;
  /// Reads on, or from the start again, until these frames are in memory.
  void hold(std::size_t first, std::size_t last) const;
  void hold_for_step(std::size_t step) const;
  /// Of a frame in memory.
  [[nodiscard]] const Eigen::Matrix3Xd& frame(std::size_t k) const {
    return held_[k - first_held_].positions;
  }
  [[nodiscard]] double coordinate(std::size_t step, BeadId bead, int k, int axis) const;
  /// A third of a bead's velocity at a frame, per step.
  [[nodiscard]] double third_of_velocity(std::size_t frame, BeadId bead, int axis) const;
  [[nodiscard]] double weight(BeadId bead, int k) const;
  template <Motion M>
  void set_control_point(std::size_t step, BeadId b, int k, M& motion) const {
    for (int axis = 0; axis < M::dimension; ++axis)
      motion.set_coordinate(b, k, axis, coordinate(step, b, k, axis));
    motion.set_weight(b, k, weight(b, k));
    motion.set_radius(b, k, has_radii_ ? radii_[b] : 0);
  }
  /// The mean displacement; any vector makes a motion, this one dips weights the least on average.
  template <Motion M>
  [[nodiscard]] typename M::Vector drift(std::size_t step) const {
    const Eigen::Vector3d mean = (frame(step + 1) - frame(step)).rowwise().mean();
    typename M::Vector drift{};
    for (std::size_t axis = 0; axis < drift.size(); ++axis) {
      const double x = mean[static_cast<Eigen::Index>(axis)];
      drift[axis] = std::isfinite(x) ? x : 0;
    }
    return drift;
  }

  int dimension_ = 3;
  int degree_ = 1;
  bool is_lifted_ = false;
  bool has_radii_ = true;
  std::size_t frame_count_ = 0;
  std::vector<BeadRange> necklaces_;
  std::vector<std::string> bead_names_;  // none, or of all beads
  std::vector<double> radii_;
  std::optional<AxisPlane> plane_;       // none: in space
  std::optional<Instance> instance_;     // none: sampled frames
  FrameStamp first_, last_;              // of sampled frames
  std::unique_ptr<SceneStream> stream_;  // null where all frames are held
  bool pushed_ = false, ended_ = false;  // frames that come from outside
  std::size_t most_held_ = 0;            // frames of a stream, or pushed, in memory at once
  mutable std::vector<FrameRead> held_;  // frames that follow each other, those in memory
  mutable std::size_t first_held_ = 0;
};

}  // namespace kds
