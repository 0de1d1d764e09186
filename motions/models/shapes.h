#pragma once
// The paper's necklaces at rest (section 4): beads of radius 1, `bond` diameters apart along the chain.
// Whether they are proper necklaces depends on their length (structures/necklace/necklace.h).

#include <cstddef>

#include "motions/models/shape.h"

namespace kds::models {

/// Returns a quadratic B-spline in space with five control points. Proper from 8 beads on.
[[nodiscard]] Shape spline(std::size_t beads, double bond = usual_bond);

/// Returns a helix with `turns` turns around the axis, in a cube. Proper while consecutive turns are apart,
/// from about pi turns^2 beads on.
[[nodiscard]] Shape helix(std::size_t beads, double turns, double bond = usual_bond);

/// Returns the number of turns of a helix of `beads` beads in a cube whose turns are `pitch` bonds apart. It
/// grows with the square root of the number of beads.
[[nodiscard]] double turns_at_pitch(std::size_t beads, double pitch);

/// Returns six parallel segments in the plane, connected by parabolic arcs. Proper from 44 beads on, with 40
/// and with 2.
[[nodiscard]] Shape grill(std::size_t beads, double bond = usual_bond);

/// Returns rows that trace a square (`dimension` 2, in the plane z = 0) or a cube (3) back and forth. Rows
/// are 2 (1 + gap) radii apart, and one bead beside their ends joins two rows. Many beads are cospherical.
/// `bond` must be above (1 + gap) / 2, `gap` below 1.
[[nodiscard]] Shape packed_grid(std::size_t beads, int dimension, double gap, double bond = usual_bond);

}  // namespace kds::models
