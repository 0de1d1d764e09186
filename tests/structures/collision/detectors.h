#pragma once
// Asks all static detectors the same question and checks that they agree.

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "structures/collision/balls_meet.h"
#include "structures/collision/brute_force.h"
#include "structures/collision/hierarchy_search.h"

namespace kds {

inline std::ostream& operator<<(std::ostream& out, const BeadPair& pair) {
  return out << '(' << pair.first << ' ' << pair.second << ')';
}

}  // namespace kds

namespace kds::test {

/// Counts how often hard cases occurred in a test, so that the test can require them.
struct DetectorsSeen {
  unsigned cases = 0, colliding = 0, touching = 0;
};

inline PairsAsked all_pairs(std::vector<BeadRange> necklaces, BeadId apart = 2) {
  return {std::move(necklaces), true, apart, true};
}

inline void expect_closest(const std::optional<ClosestPair>& found,
                           const std::optional<ClosestPair>& expected, const std::string& what) {
  ASSERT_EQ(found.has_value(), expected.has_value()) << what;
  if (!found) return;
  EXPECT_EQ(found->first, expected->first) << what;
  EXPECT_EQ(found->second, expected->second) << what;
  EXPECT_EQ(found->sign, expected->sign) << what;
  EXPECT_EQ(found->distance, expected->distance) << what;
}

template <int Dimension>
void expect_hierarchies_agree(const Balls<Dimension>& balls, const PairsAsked& asked,
                              const std::vector<BeadPair>& expected, double distance,
                              const std::string& what) {
  const auto closest = closest_pair_by_force(balls, asked);
  for (const Hierarchy kind : {Hierarchy::wrapped, Hierarchy::layered}) {
    const std::string by = what + ", " + std::string(hierarchy_names[static_cast<std::size_t>(kind)]);
    SphereTree<Dimension> tree(kind, asked.necklaces);
    tree.build(balls);
    const PairsFound found = find_pairs(tree, asked);
    ASSERT_EQ(found.pairs, expected) << by;
    SeparatingFamily family;
    EXPECT_EQ(find_pairs(tree, asked, family).pairs, expected) << by;
    EXPECT_EQ(family.pairs.size(), found.family) << by;
    const auto fault = family_fault(family, expected, balls, asked);
    EXPECT_FALSE(fault) << by << ": " << *fault;
    EXPECT_EQ(find_pairs(tree, asked, distance).pairs, pairs_by_force(balls, asked, distance)) << by;
    expect_closest(find_closest_pair(tree, balls, asked), closest, by);
  }
}

/// Compares all methods with brute force. `distance` belongs to a second question.
template <int Dimension>
void expect_detectors_agree(const Balls<Dimension>& balls, const PairsAsked& asked, double distance,
                            const std::string& what, DetectorsSeen& seen) {
  const std::vector<BeadPair> expected = pairs_by_force(balls, asked);
  const auto closest = closest_pair_by_force(balls, asked);
  EXPECT_EQ(closest && closest->sign <= 0, !expected.empty()) << what;
  const auto touch = [&balls](const BeadPair& pair) {
    return compare_separation(in_space<Dimension>(detail::center_of(balls, pair.first)),
                              in_space<Dimension>(detail::center_of(balls, pair.second)),
                              balls.radius(pair.first), balls.radius(pair.second), 0) == 0;
  };
  ++seen.cases;
  seen.colliding += expected.empty() ? 0 : 1;
  seen.touching += std::any_of(expected.begin(), expected.end(), touch) ? 1 : 0;
  expect_hierarchies_agree(balls, asked, expected, distance, what);
}

}  // namespace kds::test
