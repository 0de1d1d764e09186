#pragma once
// Separating families of tightly packed grids: their sizes (Theorem 3.1) and the time it takes to find them
// (Theorem 3.2), O(n log n) in the plane and O(n^(4/3)) in space.
//
// Grids have odd sides only: where a side is a power of two, nodes end where rows do, and mixed with others
// such sizes oscillate.

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "experiments/program/timing.h"
#include "structures/collision/sphere_tree.h"

namespace kds {

struct FamilySize {
  std::uint64_t family = 0;       ///< pairs of spheres
  std::optional<Spread> seconds;  ///< of the search, without building the hierarchy
};

/// Of beads of radius 1, no two of which collide but neighbours along the chain. Of no rounds no time is
/// told.
[[nodiscard]] FamilySize measure_family(const Eigen::Matrix3Xd& centers, int dimension, Hierarchy hierarchy,
                                        std::size_t rounds);

/// Rows, and a bead beside each but the last that joins it to the next.
[[nodiscard]] std::size_t beads_of_grid(int dimension, std::size_t side);

/// Odd sides, growing by about a factor, of grids of 1000 to `most_beads` beads; the last is the largest.
[[nodiscard]] std::vector<std::size_t> sides_of_grids(int dimension, std::size_t most_beads);

/// n log2 n in the plane, n^(4/3) in space.
[[nodiscard]] double family_bound(int dimension, std::size_t beads);

}  // namespace kds
