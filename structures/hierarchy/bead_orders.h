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

/// Returns the order of a k-d tree: each node of the balanced tree cuts the longest side of the bounding box
/// of its centres at the median, and its children hold the beads on either side. Ties are broken by bead.
/// `centers` has one column per bead; in the plane the third row is 0. Takes O(n log n) expected time.
[[nodiscard]] std::vector<BeadId> order_by_space(const Eigen::Matrix3Xd& centers);

/// Returns the order 0, n/2, 1, n/2 + 1, ... For the points of Lemma 2.5 (models::tightness_points), beads i
/// and i + n/2 are antipodal, so that the smallest spheres of all pairs are the sphere of all points. Throws
/// std::invalid_argument if n is odd.
[[nodiscard]] std::vector<BeadId> order_by_antipodes(std::size_t n);

/// Returns the columns in this order: column k of the result is column order[k] of `centers`.
[[nodiscard]] Eigen::Matrix3Xd in_order(const Eigen::Matrix3Xd& centers, std::span<const BeadId> order);

}  // namespace kds
