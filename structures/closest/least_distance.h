#pragma once
// How near two centres come to each other in a step: an enclosure, from control points in double.
//
// Let d(u) be their difference, in Bernstein form on a part of the step. For any unit vector n and all u
// there, |d(u)| >= n d(u) >= min_k n d_k; and no distance is larger than one at some u. Parts are halved, n
// being the direction of d in the middle and d_k the control points of both halves, until both bounds are
// within 2^-36 of each other or of the rounding of all that is computed, which has a margin of 2^-40 of the
// largest control point.

#include "motions/curves/curves.h"

namespace kds {

struct LeastDistance {
  double lower = 0, upper = 0;  ///< the least distance lies between them
  double at = 0;                ///< a time at which the distance is at most `upper`
};

/// Where doubles overflow nothing is known: from 0 to infinity. Of two beads that turn around each other at
/// nearly one distance parts are many: milliseconds at degree 15, seconds at degree 61.
template <int Dimension>
[[nodiscard]] LeastDistance least_distance(const Curves<Dimension>& curves, BeadId a, BeadId b);

}  // namespace kds
