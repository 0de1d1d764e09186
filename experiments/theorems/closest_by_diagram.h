#pragma once
// Compares the closest pair by power diagram (Theorem 3.5) with the closest pair by a search of the
// hierarchy.

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>

#include "experiments/program/timing.h"

namespace kds {

struct ClosestByDiagram {
  std::uint64_t looked_at = 0;  ///< pairs that the diagram and the chain give
  Spread seconds;               ///< time, diagram included
  bool same = false;  ///< whether the hierarchy search, which considers all pairs, finds the same pair
};

/// Requires at least three beads of radius 1, of which consecutive beads meet and no others.
[[nodiscard]] ClosestByDiagram closest_by_diagram(const Eigen::Matrix3Xd& centers, int dimension,
                                                  std::size_t rounds);

}  // namespace kds
