#pragma once
// All beads of a run on one clock, and the discrete-step adapter: Scene::load turns sampled frames into the
// motion of a step. An instance file gives a single step. Beads are numbered necklace after necklace.

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
  /// Cubic Hermite curves. Velocities are central differences over frames, one-sided at the first and last
  /// frame, so the motion is continuously differentiable up to rounding.
  hermite,
  /// Linear, with weights such that each sphere moves on a straight line in lifted space (lifted_motion.h).
  lifted,
};
/// Names, in the order of the enumerators.
inline constexpr std::array<std::string_view, 3> frame_motion_names{"linear", "hermite", "lifted"};
[[nodiscard]] constexpr std::string_view name_of(FrameMotion motion) {
  return frame_motion_names[static_cast<std::size_t>(motion)];
}

/// The properties of a scene that are known before its first frame is pushed.
struct PushedFrames {
  int dimension = 3;                        ///< 1 to 3
  std::vector<std::size_t> necklaces = {};  ///< number of beads in each necklace
  std::vector<double> radii = {};           ///< one per bead, or one for all; empty: points
  FrameMotion motion = FrameMotion::linear;
};

class Scene {
 public:
  /// Makes a scene of necklaces with equal numbers of frames; a necklace with a single frame is at rest.
  /// `radii`: one per bead in scene order. Throws InputError if the numbers of frames differ, or if a number
  /// is not finite. If all beads stay in one plane x, y or z = constant in all frames, the scene is planar:
  /// two-dimensional, in that plane's coordinates. This requires at least four beads, because fewer beads
  /// always lie in some plane.
  Scene(std::span<const Trajectory> necklaces, std::vector<double> radii,
        FrameMotion motion = FrameMotion::linear);
  /// Makes a scene of files that are read frame by frame. Only the frames needed for the motion of one step
  /// are in memory: two, or four for Hermite curves. Loading steps and accessing frames is fast in ascending
  /// order; going back reads the files again from the start. `survey` must be that of the stream.
  Scene(std::unique_ptr<SceneStream> frames, const SceneSurvey& survey, std::vector<double> radii,
        FrameMotion motion = FrameMotion::linear);
  /// Makes a scene of points, or of balls if `radii` has one radius per point. Throws InputError like the
  /// first constructor.
  explicit Scene(Instance instance, std::vector<double> radii = {});
  /// Makes a scene whose frames are pushed one by one. Only the frames of the latest step are in memory.
  /// Throws InputError if there are no beads, or if a radius or the dimension is invalid.
  explicit Scene(PushedFrames frames);

  /// Appends a frame: the coordinates of bead 0, then those of bead 1 and so on, `dimension` numbers each.
  /// Throws InputError, and ignores the frame, if the number of coordinates is wrong or one is not finite.
  /// Throws std::logic_error if the scene has frames of its own or has ended.
  void push(std::span<const double> coordinates, std::optional<double> picoseconds = std::nullopt);
  /// Declares that no further frame follows.
  void end_frames() { ended_ = true; }
  /// Returns the number of steps whose motion is known. These are all steps, except in a scene of pushed
  /// frames. There, Hermite curves are known one frame later, or when the frames end.
  [[nodiscard]] std::size_t known_steps() const;

  [[nodiscard]] int dimension() const { return dimension_; }
  [[nodiscard]] int degree() const { return degree_; }
  [[nodiscard]] bool is_lifted() const { return is_lifted_; }
  [[nodiscard]] std::size_t bead_count() const { return radii_.size(); }
  /// Returns the number of frames. An instance has two, u = 0 and u = 1. For pushed frames, returns how many
  /// have been pushed.
  [[nodiscard]] std::size_t frame_count() const { return frame_count_; }
  [[nodiscard]] std::size_t step_count() const { return frame_count_ == 0 ? 0 : frame_count_ - 1; }

  // Functions with an index of a frame, step or bead throw std::invalid_argument if it is too large. The
  // message gives the number of elements.

  /// Returns a frame's number in the file and its time, for messages and results.
  [[nodiscard]] FrameStamp stamp(std::size_t frame) const;
  [[nodiscard]] std::size_t frame_number(std::size_t frame) const { return stamp(frame).number; }
  [[nodiscard]] const std::vector<BeadRange>& necklaces() const { return necklaces_; }
  /// Returns the bead's name in the file, as in "CA of ALA 12 in chain A", or an empty text if it has none.
  [[nodiscard]] const std::string& bead_name(BeadId bead) const {
    static const std::string unnamed;
    require_index("bead", bead, bead_count());
    return bead < bead_names_.size() ? bead_names_[bead] : unnamed;
  }
  [[nodiscard]] const std::vector<double>& radii() const { return radii_; }
  [[nodiscard]] bool equal_radii() const;
  /// Returns whether any bead has a name.
  [[nodiscard]] bool names_beads() const { return !bead_names_.empty(); }
  /// Returns whether beads have radii. Beads of an instance file have at most weights.
  [[nodiscard]] bool has_radii() const { return has_radii_; }
  /// Checks weights for code that compares them. Throws InputError if a weight, a radius squared, is too
  /// small to be accurate, unless all weights are equal.
  void require_weights() const;

  /// Sets the motion of step k, between frames k and k+1. Every kind of motion matches both frames exactly.
  /// Radii are constant during a step; points of an instance have only weights.
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
  /// Returns centres and weights at a frame. Coordinates beyond the dimension are zero.
  [[nodiscard]] Eigen::Matrix3Xd centers(std::size_t frame) const;
  [[nodiscard]] std::vector<double> weights(std::size_t frame) const;
  /// Converts a point of a planar scene to the input's coordinates. In other scenes the point is returned
  /// unchanged.
  [[nodiscard]] Eigen::Vector3d in_input(const Eigen::Vector3d& point) const;

 private:
  [[nodiscard]] bool is_sampled() const { return !instance_; }
  void begin(FrameMotion motion, const std::vector<std::size_t>& bead_counts, const std::string& longest);
  void set_necklaces(const std::vector<std::size_t>& bead_counts);
  void name_beads(std::span<const Trajectory> necklaces);
  void lay_in_plane(const std::optional<AxisPlane>& plane);
  void lay_in_plane(Eigen::Matrix3Xd& frame) const;
  /// Reads on, or again from the start, until these frames are in memory.
  void hold(std::size_t first, std::size_t last) const;
  void hold_for_step(std::size_t step) const;
  /// Returns a frame that is in memory.
  [[nodiscard]] const Eigen::Matrix3Xd& frame(std::size_t k) const {
    return held_[k - first_held_].positions;
  }
  [[nodiscard]] double coordinate(std::size_t step, BeadId bead, int k, int axis) const;
  /// Returns a third of a bead's velocity at a frame, per step.
  [[nodiscard]] double third_of_velocity(std::size_t frame, BeadId bead, int axis) const;
  [[nodiscard]] double weight(BeadId bead, int k) const;
  template <Motion M>
  void set_control_point(std::size_t step, BeadId b, int k, M& motion) const {
    for (int axis = 0; axis < M::dimension; ++axis)
      motion.set_coordinate(b, k, axis, coordinate(step, b, k, axis));
    motion.set_weight(b, k, weight(b, k));
    motion.set_radius(b, k, has_radii_ ? radii_[b] : 0);
  }
  /// Returns the drift: the mean displacement. Any vector gives a valid motion; this one lowers weights the
  /// least on average.
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
  std::vector<std::string> bead_names_;  // empty, or one per bead
  std::vector<double> radii_;
  std::optional<AxisPlane> plane_;       // none: the scene is in space
  std::optional<Instance> instance_;     // none: sampled frames
  FrameStamp first_, last_;              // of the sampled frames
  std::unique_ptr<SceneStream> stream_;  // null if all frames are in memory
  bool pushed_ = false, ended_ = false;  // frames are pushed by the caller
  std::size_t most_held_ = 0;            // most frames of a stream, or pushed, that are in memory at once
  mutable std::vector<FrameRead> held_;  // the consecutive frames in memory
  mutable std::size_t first_held_ = 0;
};

}  // namespace kds
