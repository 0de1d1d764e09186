#pragma once
// Two necklaces packed into one square or cube, for Corollary 3.3. Rows of both alternate, so that every part
// of one necklace is near parts of the other.

#include <Eigen/Core>
#include <cstddef>

namespace kds {

struct TwoChains {
  Eigen::Matrix3Xd first, second;  ///< centres of beads of radius 1
};

/// Returns two chains that run side by side through rows of `side` beads, `side` of them (one fewer if odd)
/// in each layer, and `side` layers in space. Rows are 2 (1 + gap) apart, 0 < gap < 0.9. At each turn, one
/// chain passes inside the other. Consecutive beads of a chain meet, and no others do. `side` is at least 3.
[[nodiscard]] TwoChains interleaved_grids(std::size_t side, int dimension, double gap);

}  // namespace kds
