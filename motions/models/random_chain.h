#pragma once
// A random chain that avoids itself.

#include <cstddef>

#include "motions/models/random.h"
#include "motions/models/shape.h"

namespace kds::models {

/// Each bead in a random direction from the one before, nonadjacent beads at least `clear_distance` apart,
/// all centres in a cube of whose volume the beads fill the part `fill`. Dead ends are taken back. Throws
/// InputError where no room is found.
[[nodiscard]] Shape random_chain(std::size_t beads, double fill, Random& random, double bond = usual_bond);

/// Every bead moved in a random direction, of `dimension` 2 in its plane z = 0, by up to `distance`
/// radii. No condition is kept.
[[nodiscard]] Shape jittered(Shape shape, double distance, Random& random, int dimension = 3);

}  // namespace kds::models
