#pragma once
// Finds all pairs of balls of equal radii within a distance of each other by a breadth-first walk in their
// power diagram. For equal radii the dual of the diagram is the Delaunay triangulation of the centres.
//
// Why the walk finds all pairs: the squared distance from a centre c is a linear function of the points
// lifted to (x, |x|^2), and the triangulation is the lower hull of the lifted centres. As in the simplex
// method, an edge leads from each vertex, except the lowest one, c itself, to a lower vertex. So every centre
// within reach of c is joined to c by edges among centres within reach, and a walk from c along these edges
// meets all of them.
//
// If centres are cospherical, the triangulation may be one of several, but the hull's edges belong to all of
// them. (Dickerson and Drysdale, Fixed-radius near neighbors search algorithms for points and segments, 1990,
// for the plane.)
//
// If radii are unequal, the balls within reach of a ball are not the lifted points of a half-space, so they
// need not be joined by edges. Unequal radii are therefore refused.

#include <vector>

#include "structures/collision/pairs_asked.h"
#include "structures/necklace/balls.h"
#include "structures/triangulation/diagram_edges.h"

namespace kds {

/// Returns the pairs asked for, ascending, decided exactly. If several beads share a centre, all but one of
/// them are hidden and share the neighbours of the visible one. Takes time linear in the number of beads, of
/// edges of the beads met, and of pairs found, whether asked for or not. Throws std::invalid_argument if
/// radii differ.
template <int Dimension>
[[nodiscard]] std::vector<BeadPair> pairs_by_walk(const Balls<Dimension>& balls, const DiagramEdges& diagram,
                                                  const PairsAsked& asked, double distance = 0);

}  // namespace kds
