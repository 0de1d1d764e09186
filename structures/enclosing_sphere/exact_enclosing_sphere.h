#pragma once
// Computes the minimum enclosing sphere of consecutive beads in exact arithmetic. The filters fall back on
// this function.

#include <span>

#include "structures/enclosing_sphere/basis.h"
#include "structures/enclosing_sphere/cage.h"
#include "structures/necklace/balls.h"

namespace kds {

/// Selects whether doubles may sort out the beads that are clearly inside, so that only the others are
/// decided exactly.
enum class ExactUse { where_needed, everywhere };

/// Replaces `basis`, at most Dimension + 1 arbitrary beads of the range, by the basis of beads first..last.
/// Returns their sphere, rounded. If `of_points`, it is the sphere of their centres, which requires equal
/// radii. Always terminates, because the sphere grows with every pivot.
template <int Dimension>
Cage<Dimension> enclosing_sphere_exactly(const Balls<Dimension>& balls, BeadId first, BeadId last,
                                         Basis& basis, bool of_points, ExactUse use = ExactUse::where_needed);

}  // namespace kds
