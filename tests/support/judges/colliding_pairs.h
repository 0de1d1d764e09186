#pragma once
// Finds the balls within a distance of each other by brute force over all pairs, in rationals.

#include <Eigen/Core>
#include <cmath>
#include <span>
#include <vector>

#include "motions/numbers/exact_number.h"
#include "structures/necklace/bead_pairs.h"
#include "tests/support/judges/second_numbers.h"

namespace kds::test {

/// Returns the pairs for which |a - b| <= r + s + distance.
inline std::vector<BeadPair> pairs_over_rationals(const Eigen::Matrix3Xd& centers,
                                                  std::span<const double> radii, const PairsAsked& asked,
                                                  double distance = 0) {
  std::vector<BeadPair> pairs;
  for (BeadId a = 0; a < radii.size(); ++a) {
    for (BeadId b = a + 1; b < radii.size(); ++b) {
      std::size_t of_a = 0, of_b = 0;
      while (asked.necklaces[of_a].last < a) ++of_a;
      while (asked.necklaces[of_b].last < b) ++of_b;
      if (of_a == of_b ? !asked.within || b - a < asked.apart : !asked.between) continue;
      if (!asked.at_rest.empty() && asked.at_rest[of_a] && asked.at_rest[of_b]) continue;
      // Doubles decide pairs that are farther apart than twice the reach.
      const double apart = (centers.col(Eigen::Index{a}) - centers.col(Eigen::Index{b})).norm();
      if (std::isfinite(apart) && apart > 2 * (radii[a] + radii[b] + distance)) continue;
      second::Rational square = 0;
      for (Eigen::Index axis = 0; axis < 3; ++axis) {
        const second::Rational x = second::Rational(centers(axis, a)) - second::Rational(centers(axis, b));
        square += x * x;
      }
      const second::Rational reach =
          second::Rational(radii[a]) + second::Rational(radii[b]) + second::Rational(distance);
      if (square <= reach * reach) pairs.push_back({a, b});
    }
  }
  return pairs;
}

}  // namespace kds::test
