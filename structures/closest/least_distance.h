#pragma once
// The least distance of two centres in a step: an enclosure computed from control points in doubles, by
// Bernstein subdivision.
//
// Let d(u) be the difference of the centres, in Bernstein form on a part of the step. For any unit vector n
// and all u in this part, |d(u)| >= n d(u) >= min_k n d_k; and the least distance is at most the distance at
// any u. Take the direction of d in the middle of the part as n, and the control points of both of its
// halves as d_k. Parts are halved until the two bounds differ by at most 2^-36 of themselves or by the
// rounding of the whole computation. The margin for this rounding is 2^-40 of the largest control point.

#include "motions/curves/curves.h"
#include "structures/images/shifted_beads.h"

namespace kds {

struct LeastDistance {
  double lower = 0, upper = 0;  ///< bounds of the least distance
  double at = 0;                ///< a time at which the distance is at most `upper`
};

/// If doubles overflow, the result is the trivial enclosure from 0 to infinity. Two beads that turn around
/// each other at a nearly constant distance need many parts: milliseconds at degree 15, seconds at degree 61.
/// In a periodic cell, the second bead may be moved by a shift.
template <int Dimension>
[[nodiscard]] LeastDistance least_distance(const Curves<Dimension>& curves, BeadId a, BeadId b,
                                           const CellShift<Dimension>& shift = {});

}  // namespace kds
