#pragma once
// Compares the radii of the layered and the wrapped hierarchy's roots (Theorem 2.3).

#include <Eigen/Core>
#include <cstddef>
#include <span>

namespace kds {

/// Returns layered radius / wrapped radius of the root over all balls of a necklace with at least two beads.
/// Returns 1 if both radii are 0.
[[nodiscard]] double root_ratio(const Eigen::Matrix3Xd& centers, std::span<const double> radii,
                                int dimension);

/// Returns the height of the balanced tree over this many beads: the depth of its deepest leaf.
[[nodiscard]] std::size_t tree_height(std::size_t beads);

}  // namespace kds
