#pragma once
// How much larger the layered hierarchy's root is than the wrapped one's (Theorem 2.3).

#include <Eigen/Core>
#include <cstddef>
#include <span>

namespace kds {

/// Layered radius / wrapped radius of all balls of a necklace of two beads or more; 1 where both are 0.
[[nodiscard]] double root_ratio(const Eigen::Matrix3Xd& centers, std::span<const double> radii,
                                int dimension);

/// Of the balanced tree over so many beads: how far its deepest leaf is from the root.
[[nodiscard]] std::size_t tree_height(std::size_t beads);

}  // namespace kds
