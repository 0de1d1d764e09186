#pragma once
// The contacts of balls that stand still: what a user would look for frame by frame, by a grid.

#include <Eigen/Core>
#include <span>
#include <vector>

#include "structures/collision/pairs_asked.h"

namespace kds {

/// The pairs asked about whose closed balls meet, ascending. Centres have three rows; finite. Exact.
[[nodiscard]] std::vector<BeadPair> contacts_of(const Eigen::Matrix3Xd& centers,
                                                std::span<const double> radii, const PairsAsked& asked);

}  // namespace kds
