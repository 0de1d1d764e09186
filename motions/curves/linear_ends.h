#pragma once
// Both control points of linear motion, of all beads at once: from frame to motion is a good part of a step.

#include <cstddef>

namespace kds {

/// Frames have three numbers a bead, of which the first `dimension` are taken; radii are one a bead and stay,
/// weights are their squares. `points`: two times coordinates and weight, `own_radii`: two times the radius,
/// a bead. Whether all is finite.
template <int Dimension>
[[nodiscard]] bool set_linear_ends(const double* start, const double* end, const double* radii,
                                   std::size_t beads, double* points, double* own_radii);

}  // namespace kds
