#pragma once
// One motion step: every bead's centre (and weight, and radius) is a Bezier curve in u in [0,1] with double
// control points. The control points are the motion by definition: what was rounded was rounded when they
// were made. Length unit and frame of reference are the input's; a weight is a squared length. Weights are
// what power diagrams know, radii what spheres and contacts know: neither is derived from the other here.

#include <concepts>
#include <cstddef>
#include <vector>

#include "motions/base/bead.h"

namespace kds {

/// A motion step of beads in `dimension` space, all coordinates, weights and radii of degree `degree` in u.
template <class M>
concept Motion = requires(const M& motion, BeadId bead, int k, int axis) {
  { M::dimension } -> std::convertible_to<int>;
  { M::degree } -> std::convertible_to<int>;
  { motion.bead_count() } -> std::convertible_to<std::size_t>;
  { motion.coordinate(bead, k, axis) } -> std::same_as<double>;  // k-th control point
  { motion.weight(bead, k) } -> std::same_as<double>;
  { motion.control_point(bead, k) } -> std::same_as<const double*>;
  { motion.radius(bead, k) } -> std::same_as<double>;
};

/// Whether weights follow the centres between the ends of a step (lifted_motion.h). Radii mean nothing there.
template <class M>
inline constexpr bool lifted = requires {
  requires M::is_lifted;
};

template <int DimensionValue, int DegreeValue>
class BezierMotion {
  static_assert(DimensionValue >= 1 && DimensionValue <= 3 && DegreeValue >= 1);

 public:
  static constexpr int dimension = DimensionValue;
  static constexpr int degree = DegreeValue;

  explicit BezierMotion(std::size_t beads) : records_(beads), radii_(beads) {}

  [[nodiscard]] std::size_t bead_count() const { return records_.size(); }
  [[nodiscard]] double coordinate(BeadId bead, int k, int axis) const {
    return records_[bead].control[k][axis];
  }
  [[nodiscard]] double weight(BeadId bead, int k) const { return records_[bead].control[k][dimension]; }
  /// The k-th control point with the weight last, dimension + 1 numbers in a row.
  [[nodiscard]] const double* control_point(BeadId bead, int k) const { return records_[bead].control[k]; }
  void set_coordinate(BeadId bead, int k, int axis, double value) { records_[bead].control[k][axis] = value; }
  void set_weight(BeadId bead, int k, double value) { records_[bead].control[k][dimension] = value; }
  [[nodiscard]] double radius(BeadId bead, int k) const { return radii_[bead].control[k]; }
  void set_radius(BeadId bead, int k, double value) { radii_[bead].control[k] = value; }

 private:
  // All of a bead in one place: linear motion in space fills one cache line.
  struct alignas(DimensionValue == 3 && DegreeValue == 1 ? 64 : 8) Record {
    double control[degree + 1][dimension + 1] = {};
  };
  std::vector<Record> records_;
  // Apart: few certificates ask for them.
  struct Radius {
    double control[degree + 1] = {};
  };
  std::vector<Radius> radii_;
};

static_assert(Motion<BezierMotion<3, 1>>);

}  // namespace kds
