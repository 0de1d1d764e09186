#pragma once
// How a shape moves from frame to frame. `step` is a distance in radii; a shape of `dimension` 2 stays in its
// plane z = 0.

#include <cstddef>
#include <vector>

#include "motions/models/random.h"
#include "motions/models/shape.h"

namespace kds::models {

/// Rigidly about the centroid, in space about a skew axis; the bead farthest from the axis moves along an arc
/// of `step` a frame. Every frame is made from the first one.
[[nodiscard]] std::vector<Shape> rotating(const Shape& shape, std::size_t frames, double step,
                                          int dimension = 3);

/// Bead after bead takes a step in a random direction if that keeps the necklace: its bonds at most
/// 2 `usual_bond` and nonadjacent beads at least `clear_distance` apart, also while both move linearly
/// between the frames. What is beyond these bounds at the start may not get worse. A bead that finds no such
/// step in twenty tries rests in this frame.
[[nodiscard]] std::vector<Shape> wandering(const Shape& shape, std::size_t frames, double step,
                                           Random& random, int dimension = 3);

}  // namespace kds::models
