#include "structures/box/enclosing_box.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "tests/support/inputs/moving_beads.h"
#include "tests/support/inputs/random_motion.h"
#include "tests/support/judges/moving_points.h"
#include "tests/support/rounds.h"
#include "tests/support/text_of.h"

namespace kds::enclosing_box_test {
namespace {

using namespace test;
using testing::ElementsAre;
using testing::IsEmpty;

template <Motion M>
using Box = EnclosingBox<M::dimension>;
template <Motion M>
using BoxRig = Rig<Box<M>, M>;

/// Explains which end is not extreme, or returns nothing.
template <int Dimension>
std::optional<std::string> fault_of(const EnclosingBox<Dimension>& box, const ExactPoints& points) {
  for (std::size_t e = 0; e < 2 * Dimension; ++e) {
    const second::Integer& end = points[box.ends()[e]][e / 2];
    for (BeadId b = 0; b < points.size(); ++b)
      if (e % 2 == 0 ? points[b][e / 2] < end : points[b][e / 2] > end)
        return text_of("bead ", b, " is beyond end ", e, ", bead ", box.ends()[e]);
  }
  return std::nullopt;
}

template <Motion M>
History expect_right(const std::vector<M>& steps) {
  return expect_right_at_all_times<Box<M>>(steps, fault_of<M::dimension>,
                                           [](const auto& box) { return box.ends(); });
}

std::vector<std::string> told(const History& history) {
  std::vector<std::string> lines;
  for (const Event& e : history.events) {
    const auto kind = e.change.kind;
    if (kind == 0) continue;
    lines.push_back(text_of(kind % 2 == 1 ? "min-" : "max-", "xyz"[(kind - 1) / 2], " ", e.change.ids[0], " ",
                            e.change.ids[1], " at ",
                            static_cast<double>(e.step) + 0.5 * (e.lower + e.upper)));
  }
  return lines;
}

TEST(EnclosingBox, ChangesWhereABeadOvertakesTheOutermost) {
  const History history = expect_right(through({{{0, 0, 0}, {1, 5, -1}, {3, 1, 7}},  //
                                                {{0, 0, 0}, {5, 5, -1}, {3, 1, -3}}}));
  EXPECT_THAT(told(history), ElementsAre("max-x 2 1 at 0.5", "max-z 2 0 at 0.7", "min-z 1 2 at 0.8"));
}

TEST(EnclosingBox, OfOneBeadOrNone) {
  BoxRig<Space> one(moving({{1, 2, 3}}, {{2, 1, 3}}), AuditMode::events);
  one.run();
  EXPECT_THAT(one.structure.ends(), ElementsAre(0, 0, 0, 0, 0, 0));
  EXPECT_THAT(one.history.events, IsEmpty());
  BoxRig<Space> none(Space(0), AuditMode::events);
  none.run();
  EXPECT_THAT(none.structure.ends(), IsEmpty());
}

// Among beads that move together, the structure reports the least bead. From a frame on it is the least one,
// whichever bead was reported before.
TEST(EnclosingBox, OfBeadsThatTieTheLeastIsThere) {
  const Points all_in_one(5, {1, 1, 1});
  BoxRig<Space> rig(moving(all_in_one, Points(5, {2, 0, 1})), AuditMode::events);
  rig.run();
  EXPECT_THAT(rig.structure.ends(), ElementsAre(0, 0, 0, 0, 0, 0));
  EXPECT_THAT(rig.history.events, IsEmpty());
  const History history = expect_right(through({{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}},  //
                                                {{0, 0, 0}, {2, 0, 0}, {2, 0, 0}},
                                                {{0, 0, 0}, {3, 0, 0}, {3, 0, 0}},
                                                {{0, 0, 0}, {3, 0, 0}, {4, 0, 0}}}));
  EXPECT_THAT(told(history), ElementsAre("max-x 2 1 at 1", "max-x 1 2 at 2"));
}

// However many beads meet at one time, an end changes at most once.
TEST(EnclosingBox, WhereManyMeetTheEndChangesHandsOnce) {
  Points from, to;
  for (int b = 0; b < 9; ++b) {
    from.push_back({1.0 * b, 0, 0});
    to.push_back({-1.0 * b, 0, 0});
  }
  EXPECT_THAT(told(expect_right<Space>({moving(from, to)})),
              testing::UnorderedElementsAre("min-x 0 8 at 0.5", "max-x 8 0 at 0.5"));
}

TEST(EnclosingBox, TouchingIsNoEvent) {
  BezierMotion<1, 2> motion(2);  // (2u - 1)^2, and 0
  for (const auto& [k, x] : {std::pair{0, 1.0}, {1, -1.0}, {2, 1.0}}) motion.set_coordinate(1, k, 0, x);
  const std::vector steps{motion};
  EXPECT_THAT(expect_right(steps).events, IsEmpty());
}

template <Motion M>
void try_random_motions(unsigned seed) {
  Random random(seed);
  for (int round = 0; round < test::rounds(7); ++round) {
    for (const MotionKind kind : all_motion_kinds) {
      SCOPED_TRACE(text_of("kind ", static_cast<int>(kind), ", round ", round));
      expect_right(random_steps<M>(random, 1 + random() % 12, kind, 3));
      if (testing::Test::HasFailure()) return;
    }
  }
}
TEST(EnclosingBox, RandomMotionsOnALine) { try_random_motions<BezierMotion<1, 1>>(1); }
TEST(EnclosingBox, RandomMotionsInThePlane) { try_random_motions<BezierMotion<2, 1>>(2); }
TEST(EnclosingBox, RandomMotionsInSpace) { try_random_motions<BezierMotion<3, 1>>(3); }
TEST(EnclosingBox, RandomCurvesInThePlane) { try_random_motions<BezierMotion<2, 3>>(4); }
TEST(EnclosingBox, RandomCurvesInSpace) { try_random_motions<BezierMotion<3, 3>>(5); }

TEST(EnclosingBox, OfAProtein) {
  const auto steps = trajectory_steps("villin_hp36_300K.dcd", 0, 2);
  const History history = expect_right(steps);
  EXPECT_GT(told(history).size(), 0U);
}

TEST(EnclosingBox, ABeadHasFewCertificates) {
  const auto motion = instance_motion<Space>("d3_n500_linear");
  BoxRig<Space> rig(motion);
  rig.run();
  const CertificateCounts& counts = rig.structure.statistics.certificates;
  EXPECT_LE(counts.peak, 6U * 499);
  EXPECT_LE(counts.per_bead_max, 6U * 9);
  EXPECT_LT(rig.structure.statistics.stages.exact, counts.created / 100);
}

TEST(EnclosingBox, AuditsNoticeEveryWrongEnd) {
  BoxRig<Space> rig(moving({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}, {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}));
  rig.run();
  for (std::uint8_t e = 0; e < 6; ++e) {
    const BeadId right = e % 2 == 0 ? 0 : 2;
    const auto kind = static_cast<std::uint8_t>(e + 1);
    EXPECT_EQ(rig.structure.audit(Dyadic(0.5)), std::nullopt);
    rig.structure.apply({kind, 2, {right, 1}});
    for (const double time : {0.0, 0.5, 1.0}) EXPECT_NE(rig.structure.audit(Dyadic(time)), std::nullopt);
    rig.structure.apply({kind, 2, {1, right}});
  }
}

TEST(EnclosingBox, RefusesChangesThatCannotBe) {
  BoxRig<Space> rig(moving({{0, 0, 0}, {1, 1, 1}}, {{0, 0, 0}, {1, 1, 1}}));
  rig.run();
  EXPECT_THROW(rig.structure.apply({1, 2, {1, 0}}), std::invalid_argument);
  EXPECT_THROW(rig.structure.apply({1, 2, {0, 2}}), std::invalid_argument);
  EXPECT_THROW(rig.structure.apply({0, 2, {0, 2}}), std::invalid_argument);
}

}  // namespace
}  // namespace kds::enclosing_box_test
