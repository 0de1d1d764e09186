#pragma once
// Finds the closest pair of balls by brute force over all pairs, with distances as integers of many bits.

#include <Eigen/Core>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "motions/base/bead.h"
#include "tests/support/judges/second_numbers.h"

namespace kds::test {

/// Returns |a - b| - r - s, rounded down to a multiple of 2^-500. The numbers are below 2^10 in size and
/// multiples of 2^-70. Two such distances are then equal or more than 2^-400 apart: their difference times
/// its three conjugates is a multiple of 2^-280.
inline second::Integer gap_in_units(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double r, double s) {
  const auto in_units = [](double x) { return second::Integer(std::ldexp(x, 500)); };
  second::Integer square = 0;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const second::Integer x = in_units(a[axis]) - in_units(b[axis]);
    square += x * x;
  }
  return sqrt(square) - (in_units(r) + in_units(s));
}
inline int compare_gap_units(const second::Integer& a, const second::Integer& b) {
  const second::Integer difference = a - b;
  if (abs(difference) < second::Integer(1) << 100U) return 0;
  return difference > 0 ? 1 : -1;
}

struct ClosestByForce {
  std::pair<BeadId, BeadId> beads;  ///< the first of equally close pairs
  second::Integer gap;
};

/// Returns the closest pair among the pairs that are not neighbours, or nothing if there is no such pair.
/// Numbers must be below 2^10 in size. The error of a distance in double is then far below 2^-30, so pairs
/// that are farther by more than that are skipped.
template <class AreNeighbors>
std::optional<ClosestByForce> closest_by_force(const Eigen::Matrix3Xd& centers, std::span<const double> radii,
                                               AreNeighbors are_neighbors) {
  std::optional<ClosestByForce> best;
  double least = 0;
  for (BeadId a = 0; a < radii.size(); ++a) {
    for (BeadId b = a + 1; b < radii.size(); ++b) {
      if (are_neighbors(a, b)) continue;
      const double about =
          (centers.col(Eigen::Index{a}) - centers.col(Eigen::Index{b})).norm() - radii[a] - radii[b];
      if (best && about > least + 0x1p-30) continue;
      const second::Integer gap =
          gap_in_units(centers.col(Eigen::Index{a}), centers.col(Eigen::Index{b}), radii[a], radii[b]);
      if (!best || compare_gap_units(gap, best->gap) < 0) {
        best = {{a, b}, gap};
        least = about;
      }
    }
  }
  return best;
}

}  // namespace kds::test
