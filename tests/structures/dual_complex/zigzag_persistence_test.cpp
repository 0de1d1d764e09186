#include "structures/dual_complex/zigzag_persistence.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "tests/structures/dual_complex/gudhi_betti.h"
#include "tests/support/rounds.h"

namespace kds::test {
namespace {

SimplexBeads simplex_of(const std::vector<BeadId>& beads) {
  SimplexBeads simplex{no_bead, no_bead, no_bead, no_bead};
  std::copy(beads.begin(), beads.end(), simplex.begin());
  return simplex;
}

using Ends = std::pair<std::size_t, std::size_t>;
std::set<Ends> ends_of(const ZigzagPersistence& zigzag, int dimension) {
  std::set<Ends> ends;
  for (const auto& interval : zigzag.intervals(dimension)) ends.emplace(interval.begin, interval.end);
  return ends;
}

TEST(ZigzagPersistence, ATunnelLastsFromItsEdgeToTheTriangleOrTheEdgeThatEndsIt) {
  ZigzagPersistence zigzag;
  for (BeadId bead = 0; bead < 3; ++bead) zigzag.add(true, simplex_of({bead}));  // 0 to 2
  for (const auto& edge : {std::vector<BeadId>{0, 1}, {1, 2}, {0, 2}}) zigzag.add(true, simplex_of(edge));
  zigzag.add(true, simplex_of({0, 1, 2}));   // 6: fills the tunnel of edge 5
  zigzag.add(false, simplex_of({0, 1, 2}));  // 7: opens it again
  zigzag.add(false, simplex_of({0, 1}));     // 8: ends it
  EXPECT_EQ(ends_of(zigzag, 1), (std::set<Ends>{{5, 6}, {7, 8}}));
  EXPECT_EQ(ends_of(zigzag, 0).size(), 3U);
  zigzag.add(true, simplex_of({0, 1}));  // 9: lasts until now
  const std::set<Ends> ends = ends_of(zigzag, 1);
  ASSERT_EQ(ends.size(), 3U);
  EXPECT_EQ(ends.rbegin()->first, 9U);
  EXPECT_GE(ends.rbegin()->second, zigzag.count());
}

TEST(ZigzagPersistence, AComponentThatPartsAndMeetsAgainIsOneIntervalBetween) {
  ZigzagPersistence zigzag;
  zigzag.add(true, simplex_of({0}));
  zigzag.add(true, simplex_of({1}));
  zigzag.add(true, simplex_of({0, 1}));   // 2: two components meet
  zigzag.add(false, simplex_of({0, 1}));  // 3: they part
  zigzag.add(true, simplex_of({0, 1}));   // 4: and meet
  EXPECT_TRUE(ends_of(zigzag, 0).contains({1, 2}));
  EXPECT_TRUE(ends_of(zigzag, 0).contains({3, 4}));
}

using Zigzag = std::vector<std::pair<bool, SimplexBeads>>;

/// Returns random insertions and deletions of simplices of six beads, from nothing to nothing.
Zigzag random_zigzag(std::mt19937& random) {
  Zigzag zigzag;
  std::set<SimplexBeads> complex;
  const auto faces = [&](const SimplexBeads& simplex, const SimplexBeads& other) {
    const auto end = [](const SimplexBeads& s) { return std::find(s.begin(), s.end(), no_bead); };
    return simplex != other && std::includes(other.begin(), end(other), simplex.begin(), end(simplex));
  };
  const auto change = [&](const SimplexBeads& simplex, const std::vector<BeadId>& beads) {
    const bool inserts = !complex.contains(simplex);
    for (std::size_t off = 0; inserts && off < beads.size() && beads.size() > 1; ++off) {
      std::vector<BeadId> facet = beads;
      facet.erase(facet.begin() + static_cast<std::ptrdiff_t>(off));
      if (!complex.contains(simplex_of(facet))) return;
    }
    if (!inserts && std::any_of(complex.begin(), complex.end(),
                                [&](const SimplexBeads& other) { return faces(simplex, other); }))
      return;
    inserts ? static_cast<void>(complex.insert(simplex)) : static_cast<void>(complex.erase(simplex));
    zigzag.emplace_back(inserts, simplex);
  };
  for (int tries = 0; tries < 600; ++tries) {
    std::set<BeadId> beads;
    for (std::size_t size = 1 + random() % 4; beads.size() < size;)
      beads.insert(static_cast<BeadId>(random() % 6));
    const std::vector<BeadId> list(beads.begin(), beads.end());
    change(simplex_of(list), list);
  }
  while (!complex.empty()) {
    const std::vector<SimplexBeads> left(complex.begin(), complex.end());
    for (const SimplexBeads& simplex : left) change(simplex, {});
  }
  return zigzag;
}

TEST(ZigzagPersistence, IntervalsOfTheReversedZigzagAreMirrored) {
  std::mt19937 random(7);
  std::size_t intervals = 0;
  for (int round = 0; round < rounds(40, 4); ++round) {
    const Zigzag changes = random_zigzag(random);
    ZigzagPersistence forwards, backwards;
    for (const auto& [inserts, simplex] : changes) forwards.add(inserts, simplex);
    for (auto change = changes.rbegin(); change != changes.rend(); ++change)
      backwards.add(!change->first, change->second);
    for (int dimension = 0; dimension < 3; ++dimension) {
      std::set<Ends> mirrored;
      for (const auto& [begin, end] : ends_of(backwards, dimension))
        mirrored.emplace(changes.size() - 1 - end, changes.size() - 1 - begin);
      EXPECT_EQ(mirrored, ends_of(forwards, dimension)) << "round " << round;
      intervals += mirrored.size();
    }
  }
  EXPECT_GT(intervals, 100U);
}

TEST(ZigzagPersistence, IntervalsAreAsManyAsTheBettiNumbersAtAllTimes) {
  if (!has_gudhi()) GTEST_SKIP() << "needs GUDHI (libgudhi-dev)";
  std::mt19937 random(20261130);
  std::size_t tunnels = 0, voids = 0;
  for (int round = 0; round < rounds(40, 4); ++round) {
    ZigzagPersistence zigzag;
    std::set<SimplexBeads> complex;
    std::vector<Betti> betti;
    for (const auto& [inserts, simplex] : random_zigzag(random)) {
      zigzag.add(inserts, simplex);
      inserts ? static_cast<void>(complex.insert(simplex)) : static_cast<void>(complex.erase(simplex));
      const std::vector<SimplexBeads> now(complex.begin(), complex.end());
      betti.push_back(now.empty() ? Betti{} : gudhi_betti(now));
    }
    std::vector<Betti> counted(betti.size());
    std::set<std::size_t> used;  // insertions and deletions that begin or end an interval
    for (int dimension = 0; dimension < 3; ++dimension)
      for (const auto& interval : zigzag.intervals(dimension)) {
        EXPECT_LT(interval.begin, interval.end);
        EXPECT_TRUE(used.insert(interval.begin).second && used.insert(interval.end).second);
        for (std::size_t at = interval.begin; at < std::min(interval.end, counted.size()); ++at)
          ++counted[at][static_cast<std::size_t>(dimension)];
        tunnels += dimension == 1 ? 1 : 0;
        voids += dimension == 2 ? 1 : 0;
      }
    EXPECT_EQ(counted, betti) << "round " << round;
  }
  EXPECT_GT(tunnels, 10U);
  EXPECT_GT(voids, 10U);
}

}  // namespace
}  // namespace kds::test
