#pragma once
// What a motion is: during one step every bead's centre, weight and radius is a Bezier curve in u in [0,1]
// with double control points. The control points are the motion by definition: what was rounded was rounded
// when they were made. Length unit and frame of reference are the input's; a weight is a squared length.
// Weights are what power diagrams know, radii what spheres and contacts know: neither is derived from the
// other here.

#include <concepts>
#include <cstddef>

#include "motions/base/bead.h"
#include "motions/base/floating_point.h"

namespace kds {

/// A motion step of beads in `dimension` space, all coordinates, weights and radii of degree `degree` in u,
/// or of `own_degree()` where that is not a constant (any_degree of bernstein.h). Control points of all beads
/// lie equally spaced in memory: those of one bead, and the first ones of one bead and the next.
template <class M>
concept Motion = requires(const M& motion, BeadId bead, int k, int axis) {
  { M::dimension } -> std::convertible_to<int>;
  { M::degree } -> std::convertible_to<int>;
  { motion.bead_count() } -> std::convertible_to<std::size_t>;
  { motion.coordinate(bead, k, axis) } -> std::same_as<double>;  // k-th control point
  { motion.weight(bead, k) } -> std::same_as<double>;
  { motion.control_point(bead, k) } -> std::same_as<const double*>;  // coordinates, then the weight
  { motion.radius(bead, k) } -> std::same_as<double>;
  { motion.radii(bead) } -> std::same_as<const double*>;  // of all control points in a row
};

/// The degree of the curves of a motion's beads.
template <Motion M>
[[nodiscard]] constexpr int degree_of(const M& motion) {
  if constexpr (M::degree < 0) {
    return motion.own_degree();
  } else {
    return M::degree;
  }
}

/// Whether weights follow the centres between the ends of a step (lifted_motion.h). Radii mean nothing there.
template <class M>
inline constexpr bool lifted = requires {
  requires M::is_lifted;
};

}  // namespace kds
