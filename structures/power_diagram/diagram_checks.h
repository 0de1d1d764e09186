#pragma once
// Checks of a kinetic power diagram. At a frame, the diagram is compared with the static build. Between
// events, it is proved regular (regularity_proof.h) or, if the proof fails, compared with a static build from
// exact positions. Degenerate positions have several regular triangulations: if the static build differs, the
// definition decides by exact signs alone (regularity_fault.h).

#include <optional>
#include <span>
#include <string>

#include "structures/power_diagram/diagram_state.h"

namespace kds {

// The hull of a power diagram must wind around its inside once.
//
// Certificates guard the hull by local convexity: the two faces that meet at an edge of the hull (in the
// plane: the two edges at a vertex) do not bend outwards. A locally convex hull is convex only if it winds
// around once.
//
// In the plane, a closed polygon that turns one way is convex if and only if its edges make one full turn.
//
// In space, a closed surface that is convex around each of its vertices bounds a convex set (van Heijenoort,
// "On locally convex manifolds", 1952). The faces around a vertex form a cone, which can wind around twice
// while each of its edges is convex. Two windings take at least five faces, since a face spans less than half
// a turn.
//
// If the hull winds once, all finite cells are positive and all facets are regular, then the cells cover the
// hull once and the triangulation is regular: a lifted surface that is convex at each facet is convex.
//
// The winding number is constant while no face of the hull is flat and no two adjacent faces fold onto each
// other. Flat faces and folded faces make a certificate of the hull zero: a flat face flattens its finite
// cell, and folded faces are coplanar. Certificates report even roots too (TouchPolicy::reported). The
// winding number therefore changes only at a moment at which a certificate of the hull touches zero, or at
// which several vanish. Such a moment raises a doubt (Doubt::unclear), and this check follows. In general
// position no doubt arises and nothing is checked.
//
// A cell that becomes flat inside the hull needs no check of its own: it has neighbours on both sides of its
// plane, so the power test of one of its facets is zero or negative at that time.
//
// All signs are exact, just after the present time.

/// Returns whether the hull winds once, if it did so before the present moment and only `touched` cells
/// changed or became flat since. All facets must be regular and all finite cells positive just after now.
/// Cost: in the plane one sign for each edge of the hull, in space the squared number of faces around each
/// vertex of a touched infinite cell.
[[nodiscard]] bool hull_winds_once(DiagramState<2>& state, std::span<const CellId> touched);
[[nodiscard]] bool hull_winds_once(DiagramState<3>& state, std::span<const CellId> touched);

/// Returns whether the diagram is wrong just after the present time, by exact signs.
template <int Dimension>
[[nodiscard]] bool is_wrong_just_after(DiagramState<Dimension>& state);

/// See KineticStructure::audit.
template <int Dimension>
[[nodiscard]] std::optional<std::string> audit_of(const DiagramState<Dimension>& state, const Dyadic& time);

}  // namespace kds
