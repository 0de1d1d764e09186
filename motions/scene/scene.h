#pragma once
// All beads of a run on one clock: sampled frames become motion steps (the discrete-step adapter), or an
// instance file gives one step by itself. Beads are numbered necklace after necklace.

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "motions/base/bead_range.h"
#include "motions/curves/bezier_motion.h"
#include "motions/curves/lifted_motion.h"
#include "motions/readers/instance.h"
#include "motions/readers/trajectory.h"

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

class Scene {
 public:
  /// Necklaces of equal frame counts; one of a single frame is at rest. `radii`: one a bead in scene order.
  /// Throws InputError where the counts differ, and where a number has no exact value (NaN, infinities).
  /// Where all beads keep to one plane x, y or z = constant in all frames, the scene is planar:
  /// two-dimensional, in that plane's coordinates (from four beads on, as fewer always keep to some plane).
  Scene(std::span<const Trajectory> necklaces, std::vector<double> radii,
        FrameMotion motion = FrameMotion::linear);
  /// Points, or balls of these radii where they are given, one a point. Throws InputError likewise.
  explicit Scene(Instance instance, std::vector<double> radii = {});

  [[nodiscard]] int dimension() const { return dimension_; }
  [[nodiscard]] int degree() const { return degree_; }
  [[nodiscard]] bool is_lifted() const { return is_lifted_; }
  [[nodiscard]] std::size_t bead_count() const { return radii_.size(); }
  /// An instance has two: u = 0 and u = 1.
  [[nodiscard]] std::size_t frame_count() const { return frame_count_; }
  [[nodiscard]] std::size_t step_count() const { return frame_count_ - 1; }
  /// Of the file, for messages and results.
  [[nodiscard]] std::size_t frame_number(std::size_t frame) const {
    return frame < frame_numbers_.size() ? frame_numbers_[frame] : frame;
  }
  /// Of the frames, in picoseconds; empty where the file has none.
  [[nodiscard]] const std::vector<double>& times() const { return times_; }
  [[nodiscard]] const std::vector<BeadRange>& necklaces() const { return necklaces_; }
  [[nodiscard]] const std::vector<double>& radii() const { return radii_; }
  [[nodiscard]] bool equal_radii() const;
  /// Those of an instance file have weights at most.
  [[nodiscard]] bool has_radii() const { return has_radii_; }
  /// For what compares weights: throws InputError where a weight, a radius squared, is too small a number to
  /// be right, unless all are the same.
  void require_weights() const;

  /// Sets the motion of step k, between frames k and k+1. Both frames are met exactly, whatever the kind of
  /// motion. Radii do not change during a step; the points of an instance have none, only weights.
  template <Motion M>
  void load(std::size_t step, M& motion) const {
    if (M::degree == 1 && !frames_.empty()) {
      load_between_frames(step, motion);
    } else {
      for (BeadId b = 0; b < bead_count(); ++b) {
        for (int k = 0; k <= degree_; ++k) set_control_point(step, b, k, motion);
      }
    }
    if constexpr (lifted<M>) motion.set_drift(drift<M>(step));
  }
  /// Centres and weights at a frame; from the dimension on coordinates are zero.
  [[nodiscard]] Eigen::Matrix3Xd centers(std::size_t frame) const;
  [[nodiscard]] std::vector<double> weights(std::size_t frame) const;
  /// Where a point of a planar scene is in the input's coordinates; others are there.
  [[nodiscard]] Eigen::Vector3d in_input(const Eigen::Vector3d& point) const;

 private:
  void lay_in_plane();
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
  /// The same on straight lines, where it is a good part of a step.
  template <Motion M>
  void load_between_frames(std::size_t step, M& motion) const {
    for (BeadId b = 0; b < bead_count(); ++b) {
      const double radius = radii_[b];
      for (int k = 0; k <= 1; ++k) {
        const double* const center = frames_[step + static_cast<std::size_t>(k)].data() + 3 * std::size_t{b};
        for (int axis = 0; axis < M::dimension; ++axis) motion.set_coordinate(b, k, axis, center[axis]);
        motion.set_weight(b, k, radius * radius);
        motion.set_radius(b, k, radius);
      }
    }
  }
  /// The mean displacement; any vector makes a motion, this one dips weights the least on average.
  template <Motion M>
  [[nodiscard]] typename M::Vector drift(std::size_t step) const {
    const Eigen::Vector3d mean = (frames_[step + 1] - frames_[step]).rowwise().mean();
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
  std::vector<double> radii_;
  std::vector<Eigen::Matrix3Xd> frames_;       // of the whole scene; empty for an instance
  std::array<Eigen::Index, 3> axes_{0, 1, 2};  // the input's, of each axis of the scene
  double height_ = 0;                          // of a planar scene along the last of them
  Instance instance_;
  std::vector<std::size_t> frame_numbers_;  // empty: from 0 on
  std::vector<double> times_;
};

}  // namespace kds
