#pragma once
// Motion of a shape from frame to frame. `step` is a distance in radii. A shape of `dimension` 2 stays in its
// plane z = 0.

#include <cstddef>
#include <vector>

#include "motions/models/elementary.h"
#include "motions/models/shapes.h"

namespace kds::models {

/// Rotates the shape rigidly about its centroid; in space, about a skew axis. The bead farthest from the axis
/// moves along an arc of length `step` per frame. Every frame is computed from the first one.
[[nodiscard]] std::vector<Shape> rotating(const Shape& shape, std::size_t frames, double step,
                                          int dimension = 3);

/// Moves the beads one after the other. Each takes a step in a random direction that preserves the necklace:
/// its bonds stay at most 2 `usual_bond` long and nonadjacent beads at least `clear_distance` apart, also
/// while both beads move linearly between the frames. Bounds violated at the start may not get worse. A bead
/// that finds no such step in twenty tries rests in this frame.
[[nodiscard]] std::vector<Shape> wandering(const Shape& shape, std::size_t frames, double step,
                                           Random& random, int dimension = 3);

}  // namespace kds::models
