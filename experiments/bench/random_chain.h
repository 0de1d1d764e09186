#pragma once
// Self-avoiding chains of touching beads with radius 1, and their motions.

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "experiments/bench/bench_chains.h"
#include "motions/curves/bezier_motion.h"

namespace kds::bench {

using Random = std::mt19937_64;
using Point = std::array<double, 3>;

inline Point random_direction(Random& random) {
  std::normal_distribution<double> normal;
  Point d{normal(random), normal(random), normal(random)};
  const double length = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
  for (double& x : d) x /= length;
  return d;
}

inline std::vector<Point> random_chain(std::size_t beads) {
  const Eigen::Matrix3Xd centers = model_at_rest("random-chain", beads);
  std::vector<Point> chain(beads);
  for (std::size_t b = 0; b < beads; ++b) {
    const auto c = centers.col(static_cast<Eigen::Index>(b));
    chain[b] = {c.x(), c.y(), c.z()};
  }
  return chain;
}

/// Moves every bead by `distance` in its own direction. The velocities at both ends (Hermite) differ from
/// this displacement by the same length.
template <Motion M>
M jostled(const std::vector<Point>& beads, double distance, Random& random) {
  static_assert(M::degree == 1 || M::degree == 3);
  M motion(beads.size());
  for (BeadId b = 0; b < beads.size(); ++b) {
    const Point step = random_direction(random);
    const Point first = random_direction(random);
    const Point last = random_direction(random);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double start = beads[b][axis];
      const double end = start + distance * step[axis];
      const int i = static_cast<int>(axis);
      motion.set_coordinate(b, 0, i, start);
      motion.set_coordinate(b, M::degree, i, end);
      if constexpr (M::degree == 3) {
        motion.set_coordinate(b, 1, i, start + distance * (step[axis] + first[axis]) / 3);
        motion.set_coordinate(b, 2, i, end - distance * (step[axis] + last[axis]) / 3);
      }
    }
    for (int k = 0; k <= M::degree; ++k) motion.set_weight(b, k, 1);
  }
  return motion;
}

}  // namespace kds::bench
