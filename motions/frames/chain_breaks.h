#pragma once
// Detects chain breaks: places where residues are missing, so that two consecutive beads are far apart.

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

namespace kds {

/// b for each bond b to b+1 of this frame that is longer than 1.5 times the median bond; needs three beads.
[[nodiscard]] std::vector<std::size_t> find_chain_breaks(const Eigen::Ref<const Eigen::Matrix3Xd>& frame);

/// Returns one line that names the first ten places.
[[nodiscard]] std::string describe_chain_breaks(const std::string& file,
                                                const std::vector<std::size_t>& breaks);

}  // namespace kds
