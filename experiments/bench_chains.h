#pragma once
// Chains that benchmarks of hierarchies run on: a helix of ten turns in a cube, a chain that traces a
// jittered grid, a self-avoiding random chain of touching beads. The same for the same number of beads.

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

namespace kds {

struct BenchChain {
  std::string name;
  double radius = 0;
  Eigen::Matrix3Xd centers;
};

[[nodiscard]] BenchChain helix_chain(std::size_t beads);
/// Beads .9 of the spacing wide, up to .05 of it off the grid along each axis.
[[nodiscard]] BenchChain packed_chain(std::size_t beads);
/// Beads of radius 1 that fill a fifth of a cube.
[[nodiscard]] BenchChain random_chain(std::size_t beads);

/// Frame after frame every bead moves `distance` in a direction of its own.
[[nodiscard]] std::vector<Eigen::Matrix3Xd> jostled_frames(const Eigen::Matrix3Xd& start, double distance,
                                                           std::size_t frames);

}  // namespace kds
