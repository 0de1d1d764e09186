#pragma once
// Proves that a triangulation of beads is regular at one time. The proof is a program checker: it builds no
// second triangulation. Doubles with error bounds decide nearly all signs; an exact judge decides the
// remaining ones (ties).
//
// The checks:
//   1. The cells close up: two neighbours name each other, share their facet, and lie on its two sides.
//   2. All finite cells are positive.
//   3. No ridge of the hull is reflex, a point lies strictly inside all of the hull's faces, and a ray from
//      that point meets one face only.
//   4. No power test of a facet between finite cells is negative.
//   5. Each bead that is not absent is a vertex, or is hidden in its host and not inside the host's power
//      sphere.
//
// By 3 the hull bounds a convex polytope (Mehlhorn et al., "Checking geometric programs or verification of
// geometric structures", 1999): seen from the point, the faces cover all directions equally often, and the
// ray shows how often. Two coplanar faces that share a ridge do not overlap, because the point lies inside of
// both. By 1 and 2 the cells cover each point as often as the hull winds around it: once inside, never
// outside. By 4 the lifted cells are a convex function over the hull. By 5 every bead lies on or above the
// graph of this function. If no sign is zero, the function is strictly convex at each facet, and no other
// triangulation is regular.

#include <span>

#include "motions/curves/positions.h"
#include "structures/triangulation/hidden_beads.h"
#include "structures/triangulation/regular_triangulation.h"
#include "structures/triangulation/regularity_fault.h"

namespace kds {

/// Returns whether all five checks are proved, in time linear in the number of cells. Beads marked in
/// `absent` are ignored. Without a `judge` for the signs that doubles leave open, only a triangulation that
/// is the only regular one can be proved. A false result does not mean that the triangulation is wrong: the
/// point of check 3 is placed by doubles alone.
template <int Dimension>
[[nodiscard]] bool is_proved_regular(const RegularTriangulation<Dimension>& triangulation,
                                     std::span<const HiddenBead> hidden,
                                     const RoundedPositions<Dimension>& positions,
                                     std::span<const char> absent = {},
                                     const SignsOfFunctions<Dimension>* judge = nullptr);

}  // namespace kds
