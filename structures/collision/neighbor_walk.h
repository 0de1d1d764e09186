#pragma once
// All pairs of balls of equal radii within a distance of each other, by walking the neighbours of their
// diagram, which is the Delaunay triangulation of their centres.
//
// Why this finds them all: the square distance from a centre c is a linear function of points lifted to
// (x, |x|^2), and the triangulation is the lower hull of the lifted centres, seen from below. From each of
// its vertices but the lowest, c itself, an edge leads to a lower one, as the simplex method has it. So every
// centre within reach of c is joined to c by edges among centres within reach: walking from c through these
// meets all. Where centres are cospherical the triangulation may be one of several; the hull's edges are in
// all of them. (Dickerson and Drysdale, Fixed-radius near neighbors search algorithms for points and
// segments, 1990, for the plane.)
//
// Balls of unequal radii within reach of a ball are those of no half-space of lifted points, and need not be
// joined: they are refused.

#include <vector>

#include "structures/collision/pairs_asked.h"
#include "structures/necklace/balls.h"
#include "structures/triangulation/diagram_edges.h"

namespace kds {

/// The pairs asked for, ascending, decided exactly. Beads of one centre are hidden but for one of them, which
/// they share its neighbours with. Time linear in beads, in the edges of the beads met, and in the pairs
/// found, asked for or not. Throws std::invalid_argument where radii differ.
template <int Dimension>
[[nodiscard]] std::vector<BeadPair> pairs_by_walk(const Balls<Dimension>& balls, const DiagramEdges& diagram,
                                                  const PairsAsked& asked, double distance = 0);

}  // namespace kds
