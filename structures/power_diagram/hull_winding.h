#pragma once
// Whether the hull of a power diagram winds around its inside once.
//
// Certificates guard the hull by local convexity: at each edge (in the plane: vertex) of the hull the two
// faces that meet there do not bend outwards. That makes the hull the boundary of a convex set only if it
// winds around once.
//
//   Plane   A closed polygon that turns one way is convex if and only if its edges turn by one full turn in
//   all. Space   A closed surface that is convex around each of its vertices is the boundary of a convex set
//   (van Heijenoort,
//           "On locally convex manifolds", 1952). Around a vertex the faces form a cone, which can wind
//           around twice while each of its edges is convex. Two windings take five faces or more, since a
//           face spans less than half a turn.
//
// With winding number one, positive finite cells and locally regular facets, the cells cover the hull once,
// and the triangulation is the regular one (a lifted surface that is convex at each facet is convex).
//
// When the winding number can change. It is constant while no face of the hull is flat and no two adjacent
// faces fold onto each other. Both make an orientation zero that is a certificate of the hull: a flat face
// flattens its finite cell, and a fold is two coplanar faces. Cells inside the hull need no such care: a cell
// that becomes flat there has neighbours on both sides of its plane, so the power test of one of its facets
// is zero or negative at that time. Certificates are told of their even roots as well (TouchPolicy::
// reported), so the winding number changes only at a moment at which some certificate of the hull vanishes
// and either only touches zero, or is not the only one. Such moments raise a doubt (Doubt::unclear), and the
// check below follows. In general position no doubt arises and nothing is checked.
//
// Exact: all signs are those just after the present time.

#include <span>

#include "structures/power_diagram/diagram_state.h"

namespace kds {

/// Whether the hull winds once, if it did so before the present moment and only `touched` cells changed or
/// became flat since. All facets must be regular and all finite cells positive just after now. Cost: in the
/// plane one sign for each edge of the hull, in space the squared number of faces around each vertex of a
/// touched infinite cell.
template <int Dimension>
[[nodiscard]] bool hull_winds_once(DiagramState<Dimension>& state, std::span<const CellId> touched);

}  // namespace kds
