#pragma once
// Proves that a triangulation is the only regular one of its beads at one time. It is a program checker: it
// uses no certificate and builds nothing again. Doubles with error bounds decide the signs. In degenerate
// positions they prove nothing, the answer is no, and an exact method has to decide.
//
// The checks:
//   1. The cells close up: two neighbours name each other, share their facet, and lie on its two sides.
//   2. All finite cells are positive.
//   3. The hull is convex at each of its ridges, a point lies inside all of its faces, and a ray from that
//      point meets one face only.
//   4. All power tests of facets between finite cells are positive.
//   5. Each bead that is not absent is a vertex, or is hidden strictly inside its host and outside the
//      host's power sphere.
//
// By 3 the hull bounds a convex polytope (Mehlhorn et al., "Checking geometric programs or verification of
// geometric structures", 1999): seen from the point, the faces cover all directions equally often, and the
// ray says how often. By 1 and 2 the cells cover each point as often as the hull winds around it: once
// inside, never outside. By 4 the lifted cells are a convex function over the hull, strictly convex at each
// facet. By 5 every bead lies on or above the graph of that function.

#include <span>

#include "motions/curves/rounded_positions.h"
#include "structures/triangulation/hidden_beads.h"
#include "structures/triangulation/regular_triangulation.h"

namespace kds {

/// Returns whether all five checks are proved, in time linear in the number of cells. Beads marked in
/// `absent` do not take part.
template <int Dimension>
[[nodiscard]] bool is_strictly_regular(const RegularTriangulation<Dimension>& triangulation,
                                       std::span<const HiddenBead> hidden,
                                       const RoundedPositions<Dimension>& positions,
                                       std::span<const char> absent = {});

}  // namespace kds
