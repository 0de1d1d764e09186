#pragma once
// Sizes of separating families of packed grids against Theorem 3.1: O(n log n) in the plane, O(n^(4/3)) in
// space.
//
// Grids have odd sides only: where a side is a power of two, nodes end where rows do, and mixed with others
// such sizes oscillate.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "structures/collision/sphere_tree.h"

namespace kds {

struct FamilySize {
  int dimension = 3;
  Hierarchy hierarchy = Hierarchy::wrapped;
  std::size_t side = 0, beads = 0;
  std::uint64_t family = 0;  ///< pairs of spheres
  double seconds = 0;        ///< of the search, without building the hierarchy
  double build_seconds = 0;

  /// n log2 n in the plane, n^(4/3) in space.
  [[nodiscard]] double bound() const;
  [[nodiscard]] double ratio() const { return static_cast<double>(family) / bound(); }
};

/// Whole grids with rows to and fro, consecutive beads overlapping, all others disjoint; rows are `gap`
/// diameters apart.
[[nodiscard]] FamilySize measure_family(int dimension, Hierarchy hierarchy, std::size_t side, double gap);

/// Odd sides, growing by about a factor, of grids of 1000 to `most_beads` beads; the last is the largest.
[[nodiscard]] std::vector<std::size_t> sides_of_grids(int dimension, std::size_t most_beads);

/// A power of n fitted to sizes by least squares of logarithms, with its confidence interval.
struct FittedExponent {
  int dimension = 3;
  Hierarchy hierarchy = Hierarchy::wrapped;
  std::size_t sizes = 0;
  double exponent = 0, lower = 0, upper = 0;  ///< at 95 percent, errors taken to be normal
  double expected = 0;                        ///< by the theorem
};

/// In the plane of size / log2 n, which the theorem bounds by a power of 1; in space of the size itself. All
/// of one dimension and hierarchy. None for fewer than three sizes.
[[nodiscard]] std::optional<FittedExponent> fit_exponent(std::span<const FamilySize> sizes);

}  // namespace kds
