#pragma once
// Static diagrams of the beads present, built by CGAL from exact positions at a time of the step, or from
// doubles at its ends. The kinetic diagram is built from them and compared with them.

#include <span>

#include "structures/power_diagram/diagram_state.h"
#include "structures/triangulation/diagram_edges.h"

namespace kds {

class Dyadic;

/// Returns the diagram of the given beads, which must be ascending. If `oriented`, infinite cells are
/// included and cells keep their orientation; otherwise the finite cells are returned, sorted.
template <int Dimension>
[[nodiscard]] StaticTriangulation<Dimension> static_diagram(const DiagramState<Dimension>& state,
                                                            std::span<const BeadId> beads, const Dyadic& time,
                                                            bool oriented);

/// Returns the diagram of all beads present, from the k-th control points, at an end of the step. Finite
/// cells only, sorted.
template <int Dimension>
[[nodiscard]] StaticTriangulation<Dimension> static_diagram_at_end(const DiagramState<Dimension>& state,
                                                                   int k);
/// Returns the edges of this diagram. No bead may be absent.
template <int Dimension>
[[nodiscard]] DiagramEdges static_edges_at_end(const DiagramState<Dimension>& state, int k);

}  // namespace kds
