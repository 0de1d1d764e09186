#pragma once
// A straight chain that rolls up into a logarithmic spiral, in the plane z = 0.
//
// The curvature defines the stages. A logarithmic spiral has curvature k / s at arc length s from its pole.
// Scaling the curvature to (rolled k) / s, 0 <= rolled <= 1, gives another logarithmic spiral, and the
// straight line for 0. Each stage is thus known in closed form, in complex numbers: s exp(i k log s) / (1 + i
// k).

#include <cstddef>

#include "motions/models/shape.h"

namespace kds::models {

/// Returns a stage of the spiral. The chain covers the arc lengths starting at a quarter of its own length,
/// for any `rolled`; this choice keeps the turns farthest apart. Fully rolled up (1), its tangent makes
/// `turns` turns. Its last tangent is along x, and its centroid is at the origin. Proper in all stages from
/// about 10 turns^2 beads on.
[[nodiscard]] Shape spiral(std::size_t beads, double turns, double rolled, double bond = usual_bond);

/// Returns the spiral rotated by half a turn and moved by `distance` chain lengths along y. No bead is
/// farther than half a chain length from the centroid, so for distances above 1 the two spirals are disjoint
/// in all stages.
[[nodiscard]] Shape facing_spiral(const Shape& spiral, double distance, double bond = usual_bond);

}  // namespace kds::models
