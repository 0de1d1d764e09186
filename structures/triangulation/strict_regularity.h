#pragma once
// Proves that a triangulation is the regular one of its beads at one time, and the only one, without building
// it again and without a certificate: a program checker. Signs are taken in doubles with error bounds; where
// they prove nothing, as in degenerate positions, the answer is no, and an exact method has to decide.
//
// Checked are:
//   1. The cells close up: two neighbours name each other, share their facet, and lie on opposite sides of
//   it.
//   2. All finite cells are positive.
//   3. The hull is convex at each of its ridges, a point lies inside all of its faces, and a ray from there
//      meets one face only.
//   4. All power tests of facets between finite cells are positive.
//   5. Each bead that is not absent is a vertex, or is hidden strictly inside its host and outside the host's
//      power sphere.
// By 3 the hull is the boundary of a convex polytope (Mehlhorn et al., Checking geometric programs or
// verification of geometric structures, 1999: seen from the point, faces cover all directions equally often,
// and the ray says how often). By 1 and 2 the cells cover each point as often as the hull winds around it,
// which is once inside and never outside. By 4 the lifted cells are a convex function over the hull, strictly
// so at each facet. By 5 every bead lies on or above it.

#include <span>

#include "motions/curves/rounded_positions.h"
#include "structures/triangulation/hidden_beads.h"
#include "structures/triangulation/regular_triangulation.h"

namespace kds {

/// Whether all that is proved, linear in the number of cells. Beads marked in `absent` do not take part.
template <int Dimension>
[[nodiscard]] bool is_strictly_regular(const RegularTriangulation<Dimension>& triangulation,
                                       std::span<const HiddenBead> hidden,
                                       const RoundedPositions<Dimension>& positions,
                                       std::span<const char> absent = {});

}  // namespace kds
