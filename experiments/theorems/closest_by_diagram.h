#pragma once
// The closest pair by power diagram (Theorem 3.5) beside the closest pair by a search of the hierarchy.

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>

#include "experiments/program/timing.h"

namespace kds {

struct ClosestByDiagram {
  std::uint64_t looked_at = 0;  ///< pairs that the diagram and the chain name
  Spread seconds;               ///< diagram included
  bool same = false;            ///< the search of the hierarchy, which looks at all, finds the same pair
};

/// Of three beads or more of radius 1, of which consecutive ones meet and no others.
[[nodiscard]] ClosestByDiagram closest_by_diagram(const Eigen::Matrix3Xd& centers, int dimension,
                                                  std::size_t rounds);

}  // namespace kds
