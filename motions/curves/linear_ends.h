#pragma once
// Sets both control points of linear motion for all beads at once. This conversion from frames to motion is a
// considerable part of a step.

#include <cstddef>

namespace kds {

/// Frames have three numbers per bead, of which the first `dimension` are used. Radii are one per bead and
/// constant; weights are their squares. For each bead, `points` receives two control points of coordinates
/// and weight, and `own_radii` receives the radius of both. Returns whether all numbers are finite.
template <int Dimension>
[[nodiscard]] bool set_linear_ends(const double* start, const double* end, const double* radii,
                                   std::size_t beads, double* points, double* own_radii);

}  // namespace kds
