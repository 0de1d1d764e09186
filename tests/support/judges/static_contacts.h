#pragma once
// The contacts of balls that stand still, found without the library's detectors.

#include <Eigen/Core>
#include <algorithm>
#include <span>
#include <vector>

#include "motions/scene/near_pairs.h"
#include "structures/collision/pairs_asked.h"
#include "structures/necklace/ball_distance.h"

namespace kds::test {

/// The pairs asked about whose closed balls meet, ascending. Centres have three rows; finite. Exact.
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
