#include "structures/contacts/static_contacts.h"

#include <algorithm>

#include "motions/scene/near_pairs.h"
#include "structures/necklace/ball_distance.h"

namespace kds {

std::vector<BeadPair> contacts_of(const Eigen::Matrix3Xd& centers, std::span<const double> radii,
                                  const PairsAsked& asked) {
  std::vector<BeadPair> contacts;
  visit_near_pairs(centers, radii, [&](BeadId a, BeadId b) {
    if (asked.asks({a, b}) && compare_distance(centers.col(a), centers.col(b), radii[a], radii[b]) <= 0)
      contacts.push_back({a, b});
  });
  std::sort(contacts.begin(), contacts.end());
  return contacts;
}

}  // namespace kds
