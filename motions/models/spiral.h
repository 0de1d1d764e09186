#pragma once
// A straight chain that rolls up into a logarithmic spiral, in the plane z = 0.
//
// By the curvature: a logarithmic spiral has curvature k / s at arc length s from its pole. Scaled down to
// (rolled k) / s, 0 <= rolled <= 1, this is a logarithmic spiral again, and the straight line at 0, so each
// stage is known in closed form: in complex numbers, s exp(i k log s) / (1 + i k).

#include <cstddef>

#include "motions/models/shape.h"

namespace kds::models {

/// The chain takes up the arc lengths from a quarter of its own length on, whatever `rolled`: with this the
/// turns are farthest apart. Rolled up whole (1) its tangent makes `turns` turns. Its last tangent is
/// along x, its centroid at the origin. Proper in all stages from about 10 turns^2 beads on.
[[nodiscard]] Shape spiral(std::size_t beads, double turns, double rolled, double bond = usual_bond);

/// The same turned by half a turn and moved by `distance` chain lengths along y. No bead is farther than half
/// a chain length from the centroid, so that above 1 the two are disjoint in all stages.
[[nodiscard]] Shape facing_spiral(const Shape& spiral, double distance, double bond = usual_bond);

}  // namespace kds::models
