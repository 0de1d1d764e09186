#pragma once
// A hierarchy's cages with radii rounded up: as they stand, centres and radii doubles, they hold the balls of
// their nodes exactly.

#include <vector>

#include "structures/enclosing_sphere/cage.h"
#include "structures/hierarchy/layered_hierarchy.h"
#include "structures/hierarchy/static_wrapped_hierarchy.h"
#include "structures/necklace/balls.h"

namespace kds {

/// `balls` are those the hierarchy was built for or brought to. Radii grow by 2^-49 of themselves and 2^-51
/// of the centre's coordinates, and less where exact arithmetic has decided.
template <int Dimension>
void take_outward(const StaticWrappedHierarchy<Dimension>& hierarchy, const Balls<Dimension>& balls,
                  std::vector<Cage<Dimension>>& cages);

/// As it is: a layered hierarchy rounds its radii up itself.
template <int Dimension>
void take_outward(const LayeredHierarchy<Dimension>& hierarchy, const Balls<Dimension>& balls,
                  std::vector<Cage<Dimension>>& cages);

/// The radius of a sphere of this centre around beads first..last.
template <int Dimension>
[[nodiscard]] double outward_radius(const Balls<Dimension>& balls, BeadId first, BeadId last,
                                    const Point<Dimension>& center);

}  // namespace kds
