#pragma once
// Separating families of tightly packed grids: their sizes (Theorem 3.1) and the time to find them (Theorem
// 3.2). The bounds are O(n log n) in the plane and O(n^(4/3)) in space.
//
// All grids have odd sides. If a side is a power of two, tree nodes end where rows end, and results for a
// mixture of such sizes oscillate.

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

/// Measures the family of beads with radius 1. No two beads may collide except neighbours along the chain. If
/// `rounds` is 0, no time is measured.
[[nodiscard]] FamilySize measure_family(const Eigen::Matrix3Xd& centers, int dimension, Hierarchy hierarchy,
                                        std::size_t rounds);

/// Returns the number of beads in a grid: all rows, and a bead beside each row except the last that joins it
/// to the next row.
[[nodiscard]] std::size_t beads_of_grid(int dimension, std::size_t side);

/// Returns odd sides of grids with 1000 to `most_beads` beads. The number of beads grows by a roughly
/// constant factor, and the last side is the largest possible.
[[nodiscard]] std::vector<std::size_t> sides_of_grids(int dimension, std::size_t most_beads);

/// Returns n log2 n in the plane, n^(4/3) in space.
[[nodiscard]] double family_bound(int dimension, std::size_t beads);

}  // namespace kds
