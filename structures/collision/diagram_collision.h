#pragma once
// Collision by a power diagram that is built for the query. The diagram answers Theorem 3.5 (closest_pair.h)
// and, for equal radii, finds all pairs (pairs_by_walk).

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "structures/collision/closest_pair.h"
#include "structures/necklace/balls.h"
#include "structures/necklace/bead_pairs.h"
#include "structures/triangulation/diagram_edges.h"

namespace kds {

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

/// Returns the pairs asked for, ascending, decided exactly. If several beads share a centre, all but one of
/// them are hidden and share the neighbours of the visible one. Takes time linear in the number of beads, of
/// edges of the beads met, and of pairs found, whether asked for or not. Throws std::invalid_argument if
/// radii differ.
template <int Dimension>
[[nodiscard]] std::vector<BeadPair> pairs_by_walk(const Balls<Dimension>& balls, const DiagramEdges& diagram,
                                                  const PairsAsked& asked, double distance = 0);

struct DiagramCollision {
  bool collide = false;
  std::uint64_t edges = 0;                     ///< edges of the diagram
  std::optional<std::vector<BeadPair>> pairs;  ///< all colliding pairs, ascending; none if radii differ
  /// The closest pair. None if beads of unequal radii collide, because a pair that was not tested may overlap
  /// more deeply.
  std::optional<ClosestPair> closest;
};

/// Returns a sentence that says why the diagram cannot answer the query, or none if it can. The diagram
/// covers all beads together, so the pairs not asked about must be neighbours along a chain.
template <int Dimension>
[[nodiscard]] std::optional<std::string> diagram_refusal(const Balls<Dimension>& balls,
                                                         const PairsAsked& asked);

/// Throws std::invalid_argument with the sentence of diagram_refusal.
template <int Dimension>
[[nodiscard]] DiagramCollision collide_by_diagram(const Balls<Dimension>& balls, const PairsAsked& asked);

}  // namespace kds
