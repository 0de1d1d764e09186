#pragma once
// A self-avoiding random chain.

#include <cstddef>

#include "motions/models/random.h"
#include "motions/models/shape.h"

namespace kds::models {

/// Returns a chain in which each bead lies in a random direction from the bead before. Nonadjacent beads are
/// at least `clear_distance` apart, and all centres lie in a cube of whose volume the beads fill the share
/// `fill`. Dead ends are backtracked. Throws InputError if no room is found.
[[nodiscard]] Shape random_chain(std::size_t beads, double fill, Random& random, double bond = usual_bond);

/// Moves every bead in a random direction by up to `distance` radii; for `dimension` 2 within its plane
/// z = 0. No other condition is maintained.
[[nodiscard]] Shape jittered(Shape shape, double distance, Random& random, int dimension = 3);

}  // namespace kds::models
