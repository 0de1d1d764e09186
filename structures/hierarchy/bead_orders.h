#pragma once
// Other groupings of beads than along the chain (Agarwal et al., section 2.4). A grouping is an order of the
// beads: the balanced tree over the beads in that order (necklace_tree.h) is the hierarchy. An order lists
// the beads; hierarchies are then built over the centres in this order.

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "motions/base/bead.h"

namespace kds {

/// Returns an order in which each node of the balanced tree holds the beads of one half of its parent's
/// bounding box: a k-d tree that cuts the longest side at the median. Ties are broken by bead. Takes
/// O(n log n) time.
[[nodiscard]] std::vector<BeadId> order_by_space(const Eigen::Matrix3Xd& centers);

/// Returns the order 0, n/2, 1, n/2 + 1, ... For the points of Lemma 2.5 (models::tightness_points), beads i
/// and i + n/2 are antipodal, so that the smallest spheres of all pairs are the sphere of all points. Throws
/// std::invalid_argument if n is odd.
[[nodiscard]] std::vector<BeadId> order_by_antipodes(std::size_t n);

/// Returns the columns in this order.
[[nodiscard]] Eigen::Matrix3Xd in_order(const Eigen::Matrix3Xd& centers, std::span<const BeadId> order);

}  // namespace kds
