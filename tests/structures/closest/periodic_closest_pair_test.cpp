// The closest pair by nearest images. tests/laws judges random scenes.

#include <gmock/gmock.h>

#include <optional>
#include <string>
#include <vector>

#include "structures/closest/kinetic_closest_pair.h"
#include "structures/closest/least_distance.h"
#include "tests/support/inputs/moving_beads.h"
#include "tests/support/inputs/random_cells.h"
#include "tests/support/text_of.h"

namespace kds::periodic_closest_pair_test {
namespace {

using namespace test;
using testing::ElementsAre;
using testing::IsEmpty;

template <Motion M>
using ClosestRig = Rig<KineticClosestPair<M::dimension>, M>;

template <Motion M>
History expect_right(const std::vector<M>& steps) {
  ClosestRig<M> filtered(steps.front(), AuditMode::events);
  EXPECT_NO_THROW(filtered.run(steps));
  EXPECT_TRUE(books_balance(filtered.structure.statistics));
  ClosestRig<M> exact(steps.front(), AuditMode::none, Kernel::exact);
  exact.run(steps);
  EXPECT_EQ(exact.simulator.fingerprint(), filtered.simulator.fingerprint());
  EXPECT_EQ(exact.structure.pair(), filtered.structure.pair());
  return filtered.history;
}

std::vector<std::string> told(const History& history) {
  std::vector<std::string> lines;
  for (const Event& e : history.events) {
    const auto& ids = e.change.ids;
    if (e.change.kind == KineticClosestPair<3>::replace)
      lines.push_back(text_of(ids[0], " ", ids[1], " to ", ids[2], " ", ids[3], " at ",
                              static_cast<double>(e.step) + 0.5 * (e.lower + e.upper)));
  }
  return lines;
}

TEST(PeriodicClosestPair, AcrossAWall) {
  Space step = moving({{0, 0, 0}, {4, 0, 0}, {9, 0, 0}}, {{0, 0, 0}, {4, 0, 0}, {15, 0, 0}});
  step.own_cell().set(box(16, 16, 16), box(16, 16, 16), 1);
  EXPECT_THAT(told(expect_right<Space>({step})), ElementsAre("0 1 to 0 2 at 0.5"));
  step.own_cell().set(box(0, 16, 16), box(0, 16, 16), 1);
  EXPECT_THAT(told(expect_right<Space>({step})), IsEmpty());
}

TEST(PeriodicClosestPair, AnotherImageOfTheSamePairIsNoEvent) {
  Space step = moving({{0, 0, 0}, {0, 0, 0}, {0, 6, 0}}, {{0, 0, 0}, {16, 0, 0}, {0, 6, 0}});
  step.own_cell().set(box(16, 16, 16), box(16, 16, 16), 1);
  EXPECT_THAT(told(expect_right<Space>({step})), ElementsAre("0 1 to 0 2 at 0.375", "0 2 to 0 1 at 0.625"));
  step = moving({{0, 0, 0}, {0, 0, 0}, {0, 8, 0}}, {{0, 0, 0}, {16, 0, 0}, {0, 8, 0}});
  step.own_cell().set(box(16, 16, 16), box(16, 16, 16), 1);
  EXPECT_THAT(told(expect_right<Space>({step})), IsEmpty());
}

TEST(PeriodicClosestPair, AuditsNoticeAPairThatIsNotTheClosest) {
  Space step = moving({{0, 0, 0}, {4, 0, 0}, {15, 0, 0}}, {{0, 0, 0}, {4, 0, 0}, {15, 0, 0}});
  step.own_cell().set(box(16, 16, 16), box(16, 16, 16), 1);
  ClosestRig<Space> rig(step);
  rig.run(std::vector<Space>{step});
  EXPECT_EQ(rig.structure.audit(Dyadic(0.5)), std::nullopt);
  rig.structure.apply({KineticClosestPair<3>::replace, 4, {0, 2, 0, 1}});
  EXPECT_NE(rig.structure.audit(Dyadic(0.5)), std::nullopt);
}

// Beads that follow each other along the chain are far apart, as in a slab.
TEST(PeriodicClosestPair, OfAThinCell) {
  Space step = moving({{0, 0, 0}, {0, 0, 400}, {1, 0, 0}}, {{0, 0, 0}, {0, 0, 400}, {3, 0, 0}});
  step.own_cell().set(box(10, 10, 0), box(10, 10, 0), 1);
  ClosestRig<Space> rig(step);
  rig.run(std::vector<Space>{step});
  EXPECT_THAT(*rig.structure.pair(), ElementsAre(0, 2));
}

TEST(PeriodicClosestPair, LeastDistanceOfAnImage) {
  Space step = moving({{0, 0, 0}, {12, 1, 0}}, {{0, 0, 0}, {20, 1, 0}});
  step.own_cell().set(box(16, 16, 16), box(16, 16, 16), 1);
  const LeastDistance least = least_distance(Curves<3>(step), 0, 1, {-1, 0, 0});
  EXPECT_LE(least.lower, 1);
  EXPECT_GE(least.upper, 1);
  EXPECT_LT(least.upper - least.lower, 1e-9);
  EXPECT_NEAR(least.at, 0.5, 1e-4);
}

}  // namespace
}  // namespace kds::periodic_closest_pair_test
