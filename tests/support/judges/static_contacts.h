#pragma once
// Finds the contacts of balls at rest without the library's detectors.

#include <Eigen/Core>
#include <algorithm>
#include <span>
#include <vector>

#include "motions/scene/near_pairs.h"
#include "structures/necklace/ball_distance.h"
#include "structures/necklace/bead_pairs.h"

namespace kds::test {

/// Returns, in ascending order, the pairs in question whose closed balls intersect. Centres are finite and
/// have three rows. The result is exact.
[[nodiscard]] inline std::vector<BeadPair> contacts_of(const Eigen::Matrix3Xd& centers,
                                                       std::span<const double> radii,
                                                       const PairsAsked& asked) {
  std::vector<BeadPair> contacts;
  visit_near_pairs(centers, radii, [&](BeadId a, BeadId b) {
    if (asked.asks({a, b}) && compare_distance(centers.col(a), centers.col(b), radii[a], radii[b]) <= 0)
      contacts.push_back({a, b});
  });
  std::sort(contacts.begin(), contacts.end());
  return contacts;
}

}  // namespace kds::test
