#pragma once
// The concept of a motion. During one step, every bead's centre, weight and radius is a Bezier curve in u in
// [0,1] with double control points. The control points define the motion exactly; any rounding happened when
// they were made. Length unit and frame of reference are those of the input; a weight is a squared length.
// Power diagrams use weights; spheres and contacts use radii. Neither weights nor radii are derived from the
// other here.

#include <concepts>
#include <cstddef>

#include "motions/base/bead.h"
#include "motions/base/floating_point_scope.h"

namespace kds {

/// The cell of a periodic motion during one step, in `dimension` space: each of its `dimension` vectors is a
/// Bezier curve of the motion's degree. A vector whose control points are zero spans nothing: the motion is
/// not periodic along it. A motion of beads in a cell has a member `cell()`, which returns the control points
/// in a row (coordinates of one point, then the next point of the vector, then the next vector), or null if
/// there is no cell. The images of a bead are the bead moved by whole multiples of the vectors.
template <class M>
concept HasCell = requires(const M& motion) {
  { motion.cell() } -> std::same_as<const double*>;
};

/// A motion step of beads in `dimension` space. All coordinates, weights and radii have degree `degree` in u,
/// or `own_degree()` if the degree is not a constant (any_degree of bernstein.h). Control points must be
/// equally spaced in memory, both those of one bead and the first ones of consecutive beads.
template <class M>
concept Motion = requires(const M& motion, BeadId bead, int k, int axis) {
  { M::dimension } -> std::convertible_to<int>;
  { M::degree } -> std::convertible_to<int>;
  { motion.bead_count() } -> std::convertible_to<std::size_t>;
  { motion.coordinate(bead, k, axis) } -> std::same_as<double>;  // at the k-th control point
  { motion.weight(bead, k) } -> std::same_as<double>;
  { motion.control_point(bead, k) } -> std::same_as<const double*>;  // the coordinates, then the weight
  { motion.radius(bead, k) } -> std::same_as<double>;
  { motion.radii(bead) } -> std::same_as<const double*>;  // the radii of all control points in a row
};

/// Returns the degree of the curves of a motion's beads.
template <Motion M>
[[nodiscard]] constexpr int degree_of(const M& motion) {
  if constexpr (M::degree < 0) {
    return motion.own_degree();
  } else {
    return M::degree;
  }
}

/// Whether weights follow the centres between the ends of a step (lifted_motion.h). Radii are meaningless
/// there.
template <class M>
inline constexpr bool lifted = requires {
  requires M::is_lifted;
};

}  // namespace kds
