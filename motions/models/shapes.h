#pragma once
// The shapes of the models: the paper's necklaces at rest (section 4), spirals, random chains and the points
// of a proof. Beads have radius 1 and lie `bond` diameters apart along the chain. Whether they are proper
// necklaces depends on their number (structures/necklace/necklace.h).

#include <Eigen/Core>
#include <cstddef>

#include "motions/models/elementary.h"

namespace kds::models {

/// The centres of beads of radius 1, one column each.
using Shape = Eigen::Matrix3Xd;

inline constexpr double radius = 1;

/// The distance of consecutive beads divided by their diameter. Consecutive beads overlap by a thousandth, so
/// coordinates rounded to three decimals (PDB) still give a connected necklace.
inline constexpr double usual_bond = 0.999;

/// The distance that models keep between nonadjacent beads, with a margin for the same rounding.
inline constexpr double clear_distance = 2.002;

/// Returns the squared distance, summed axis by axis in order, so that the result does not depend on how
/// Eigen vectorizes.
[[nodiscard]] inline double squared_distance(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
  return x * x + y * y + z * z;
}

[[nodiscard]] inline Eigen::Vector3d centroid(const Shape& shape) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (Eigen::Index bead = 0; bead < shape.cols(); ++bead) sum += shape.col(bead);
  return sum / static_cast<double>(shape.cols());
}

/// Returns a quadratic B-spline with five control points, in space or in the plane z = 0 (`dimension` 2).
/// Proper from 8 beads on.
[[nodiscard]] Shape spline(std::size_t beads, double bond = usual_bond, int dimension = 3);

/// Returns a helix with `turns` turns around the axis, in a cube. Proper while consecutive turns are apart,
/// from about pi turns^2 beads on.
[[nodiscard]] Shape helix(std::size_t beads, double turns, double bond = usual_bond);

/// Returns the number of turns of a helix of `beads` beads in a cube whose turns are `pitch` bonds apart. The
/// number of turns grows with the square root of the number of beads.
[[nodiscard]] double turns_at_pitch(std::size_t beads, double pitch);

/// Returns six parallel segments in the plane, connected by parabolic arcs. Proper from 44 beads on, with 40
/// and with 2.
[[nodiscard]] Shape grill(std::size_t beads, double bond = usual_bond);

/// Returns rows that trace a square (`dimension` 2, in the plane z = 0) or a cube (3) back and forth. Rows
/// are 2 (1 + gap) radii apart, and one bead beside their ends joins two rows. Many beads are cospherical.
/// `bond` must be above (1 + gap) / 2, `gap` below 1.
[[nodiscard]] Shape packed_grid(std::size_t beads, int dimension, double gap, double bond = usual_bond);

// A straight chain rolls up into a logarithmic spiral in the plane z = 0. The curvature defines the stages. A
// logarithmic spiral has curvature k / s at arc length s from its pole. Scaling the curvature to (rolled k) /
// s, 0 <= rolled <= 1, gives another logarithmic spiral, and the straight line for 0. Each stage is thus
// known in closed form, in complex numbers: s exp(i k log s) / (1 + i k).

/// Returns a stage of the spiral. The chain covers the arc lengths starting at a quarter of its own length,
/// for any `rolled`; this choice keeps the turns farthest apart. Fully rolled up (1), its tangent makes
/// `turns` turns. The last tangent of the chain is along x, and the centroid is at the origin. Proper in all
/// stages from about 10 turns^2 beads on.
[[nodiscard]] Shape spiral(std::size_t beads, double turns, double rolled, double bond = usual_bond);

/// Returns the spiral rotated by half a turn and moved by `distance` chain lengths along y. No bead is
/// farther than half a chain length from the centroid, so for distances above 1 the two spirals are disjoint
/// in all stages.
[[nodiscard]] Shape facing_spiral(const Shape& spiral, double distance, double bond = usual_bond);

/// Returns a chain in which each bead lies in a random direction from the bead before. Nonadjacent beads are
/// at least `clear_distance` apart, and all centres lie in a cube of whose volume the beads fill the share
/// `fill`. Dead ends are backtracked. Throws InputError if no room is found.
[[nodiscard]] Shape random_chain(std::size_t beads, double fill, Random& random, double bond = usual_bond);

/// Moves every bead in a random direction by up to `distance` radii; for `dimension` 2 within its plane
/// z = 0. No other condition is maintained.
[[nodiscard]] Shape jittered(Shape shape, double distance, Random& random, int dimension = 3);

}  // namespace kds::models
