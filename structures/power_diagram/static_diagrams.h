#pragma once
// The static diagrams that a kinetic one is built from and compared with, of its beads that are present, by
// CGAL: from exact positions at a time of the step, or from doubles at its ends.

#include <span>

#include "structures/power_diagram/diagram_state.h"
#include "structures/triangulation/diagram_edges.h"

namespace kds {

class Dyadic;

/// Of some beads, ascending. With `oriented`, infinite cells too, as they are; else finite ones, sorted.
template <int Dimension>
[[nodiscard]] StaticTriangulation<Dimension> static_diagram(const DiagramState<Dimension>& state,
                                                            std::span<const BeadId> beads, const Dyadic& time,
                                                            bool oriented);

/// Of all that are present, from the k-th control points, an end of the step; finite cells, sorted.
template <int Dimension>
[[nodiscard]] StaticTriangulation<Dimension> static_diagram_at_end(const DiagramState<Dimension>& state,
                                                                   int k);
/// The edges there, of all beads, none being absent.
template <int Dimension>
[[nodiscard]] DiagramEdges static_edges_at_end(const DiagramState<Dimension>& state, int k);

}  // namespace kds
