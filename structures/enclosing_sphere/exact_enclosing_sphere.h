#pragma once
// The minimum enclosing sphere of consecutive beads, decided in exact arithmetic: what filters fall back to.

#include <span>

#include "structures/enclosing_sphere/basis.h"
#include "structures/enclosing_sphere/cage.h"
#include "structures/necklace/balls.h"

namespace kds {

/// Whether doubles may tell the beads that are clearly inside from those to be decided exactly.
enum class ExactUse { where_needed, everywhere };

/// Makes `basis`, any beads of the range, at most Dimension + 1, that of beads first..last, and returns their
/// sphere, rounded; of their centres if `of_points`, which takes equal radii. Always ends: with every pivot
/// the sphere grows.
template <int Dimension>
Cage<Dimension> enclosing_sphere_exactly(const Balls<Dimension>& balls, BeadId first, BeadId last,
                                         Basis& basis, bool of_points, ExactUse use = ExactUse::where_needed);

}  // namespace kds
