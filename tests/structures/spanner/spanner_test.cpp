#include "structures/spanner/spanner.h"

#include <gmock/gmock.h>

#include "certificates/exact/exact_work.h"

#include "tests/support/inputs/moving_beads.h"
#include "tests/support/inputs/random_motion.h"
#include "tests/support/judges/moving_points.h"
#include "tests/support/judges/spanner_checks.h"
#include "tests/support/rounds.h"
#include "tests/support/text_of.h"

namespace kds::spanner_test {
namespace {

using namespace test;
using testing::ElementsAre;
using testing::IsEmpty;

template <Motion M>
using SpannerRig = Rig<Spanner<M::dimension>, M>;

/// Judges the spanner at a time of the step.
template <Motion M>
std::optional<std::string> fault_of(const SpannerRig<M>& rig, double stretch, const Dyadic& time) {
  const second::Rational u = second::of(time);
  const ExactPoints at = points_at(rig.motion, u);
  std::vector<BeadId> present;
  for (BeadId b = 0; b < at.size(); ++b)
    if (!rig.structure.is_absent(b)) present.push_back(b);
  return not_a_spanner(rig.structure, present, stretch, 4 * quarter_at(rig.motion, u),
                       [&](BeadId a, BeadId b) {
                         second::Integer sum = 0;
                         for (std::size_t axis = 0; axis < at[a].size(); ++axis)
                           sum += (at[a][axis] - at[b][axis]) * (at[a][axis] - at[b][axis]);
                         return sum;
                       });
}

/// Runs the steps with audits and a judge, by default between all events; the other kernel and a replay must
/// agree.
template <Motion M>
std::vector<std::string> expect_right(const std::vector<M>& steps, double stretch,
                                      AuditMode audits = AuditMode::events) {
  SpannerRig<M> filtered(steps.front(), audits, stretch);
  const Witness witness(filtered.simulator,
                        [&](const Dyadic& time) { return fault_of(filtered, stretch, time); });
  EXPECT_NO_THROW(filtered.run(steps));
  EXPECT_TRUE(books_balance(filtered.structure.statistics));

  SpannerRig<M> exact(steps.front(), AuditMode::none, Kernel::exact, stretch);
  exact.run(steps);
  EXPECT_EQ(exact.simulator.fingerprint(), filtered.simulator.fingerprint());
  SpannerRig<M> again(steps.front(), AuditMode::frames, stretch);
  EXPECT_NO_THROW(again.replay(steps, filtered.history));
  for (const auto* other : {&exact, &again}) {
    EXPECT_EQ(other->structure.edges(), filtered.structure.edges());
    EXPECT_EQ(other->structure.centres(), filtered.structure.centres());
  }

  std::vector<std::string> lines;
  for (const Event& e : filtered.history.events) {
    std::string line(filtered.structure.kinds()[e.change.kind].name);
    for (std::size_t k = 0; k < e.change.size; ++k) line += text_of(" ", e.change.ids[k]);
    lines.push_back(line + text_of(" at ", static_cast<double>(e.step) + 0.5 * (e.lower + e.upper)));
  }
  return lines;
}

// With a stretch of 5, c is 8. The extent is 8, so level 27 has the scale 1. The length of a certificate is
// rounded up, so that of edges fails a little before that of centres.
TEST(Spanner, OfTwoBeadsThatApproach) {
  const Points far{{0, 0, 0}, {8, 0, 0}}, near{{0, 0, 0}, {1.5, 0, 0}};
  EXPECT_THAT(
      expect_right(through({far, near, far}), 5),
      ElementsAre("rescale 0 1 26 at 0.615385", "fall 1 0 28 at 0.615385", "rescale 0 1 25 at 0.923077",
                  "fall 1 0 27 at 0.923077", "rise 1 0 28 at 1.07692", "rescale 0 1 26 at 1.07692",
                  "rise 1 0 29 at 1.38462", "rescale 0 1 27 at 1.38462"));
}

// Ten beads in a row, 16 apart, are joined with few others; the last one passes by.
TEST(Spanner, HasFewEdgesInALongRow) {
  Points from, to;
  for (int b = 0; b < 10; ++b) {
    from.push_back({16.0 * b, 0, 0});
    to.push_back({b < 9 ? 16.0 * b : -160, 1, 0});
  }
  EXPECT_THAT(expect_right(through({from, to}), 9), testing::Contains(testing::StartsWith("join")));
  SpannerRig<Space> rig(moving(from, to), AuditMode::none, 9.0);
  rig.run();
  EXPECT_LT(rig.structure.edges().size(), 45U);
}

TEST(Spanner, OfFewOrCoincidentBeads) {
  for (const std::size_t beads : {0, 1}) {
    SpannerRig<Space> rig(Space(beads), AuditMode::events, 3.0);
    rig.run();
    EXPECT_THAT(rig.structure.edges(), IsEmpty());
    EXPECT_EQ(rig.structure.centres().size(), beads);
  }
  const Points together(5, {1, 1, 1}), apart{{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 4}, {1e-12, 0, 0}};
  expect_right(through({together, apart, together, together, apart}), 3);
  expect_right(through({apart, together}), 3);
}

TEST(Spanner, RefusesAStretchOfOne) {
  const Space motion(2);
  for (const double stretch : {1.0, 0.5, HUGE_VAL, std::nan("")})
    EXPECT_THROW(SpannerRig<Space>(motion, AuditMode::none, stretch), std::invalid_argument) << stretch;
}

TEST(Spanner, RefusesLengthsBeyondDoubles) {
  SpannerRig<Space> rig(moving({{-4e307, 0, 0}, {4e307, 0, 0}}, {{0, 0, 0}, {1, 0, 0}}), AuditMode::none,
                        3.0);
  EXPECT_THROW(rig.run(), InputError);
}

template <Motion M>
void try_random_motions(unsigned seed) {
  Random random(seed);
  for (int round = 0; round < test::rounds(1); ++round) {
    for (const MotionKind kind : all_motion_kinds) {
      SCOPED_TRACE(text_of("kind ", static_cast<int>(kind), ", round ", round));
      const double stretch = std::array{1.5, 3.0, 17.0, 1e6}[random() % 4];
      expect_right(random_steps<M>(random, 1 + random() % 10, kind, 3), stretch);
      if (testing::Test::HasFailure()) return;
    }
  }
}
TEST(Spanner, RandomMotionsInThePlane) { try_random_motions<BezierMotion<2, 1>>(2); }
TEST(Spanner, RandomMotionsInSpace) { try_random_motions<BezierMotion<3, 1>>(3); }
TEST(Spanner, RandomCurvesInThePlane) { try_random_motions<BezierMotion<2, 3>>(4); }
TEST(Spanner, RandomCurvesInSpace) { try_random_motions<BezierMotion<3, 3>>(5); }

TEST(Spanner, Instances) {
  const std::vector plane{instance_motion<BezierMotion<2, 1>>("d2_n20_linear")};
  EXPECT_GT(expect_right(plane, 3).size(), 20U);
  std::vector<const char*> degenerate{"gridrigid", "converge", "gridint", "half"};
  degenerate.resize(rounds(1U));
  for (const char* name : degenerate) {
    SCOPED_TRACE(name);
    expect_right(std::vector{instance_motion<BezierMotion<2, 1>>(text_of("degenerate_d2_n64_", name))}, 9,
                 AuditMode::frames);
  }
}

// Erasing the root, and every bead in turn, leaves a spanner of the others.
TEST(Spanner, EditsOfAllBeads) {
  Random random(7);
  for (int round = 0; round < test::rounds(20); ++round) {
    const std::size_t beads = 2 + random() % 10;
    SpannerRig<BezierMotion<3, 1>> rig(random_steps<BezierMotion<3, 1>>(random, beads, MotionKind{}, 1)[0],
                                       AuditMode::events, 3.0);
    const Witness witness(rig.simulator, [&](const Dyadic& time) { return fault_of(rig, 3, time); });
    rig.simulator.build();
    rig.simulator.enter_step();
    for (BeadId b = 0; b < beads; ++b) {
      rig.simulator.run_until(Dyadic((b + 1) / 16.0));
      const BeadId bead = round % 2 == 0 ? b : static_cast<BeadId>(beads - 1 - b);
      rig.structure.erase(bead);
      rig.simulator.audit_now();
      if (b % 2 == 1) rig.structure.insert(bead);
      rig.simulator.audit_now();
    }
    rig.simulator.leave_step();
    EXPECT_EQ(rig.structure.centres().size(), beads / 2);
  }
}

// A limit of exact work ends the run: edits are refused afterwards.
TEST(Spanner, RefusesEditsAfterOneThatWasBrokenOff) {
  std::mt19937 random(3);
  const Points grid = random_grid_points(random, 40, 4);
  SpannerRig<Space> rig(moving(grid, grid), AuditMode::none, Kernel::exact, 17.0);
  rig.simulator.build();
  rig.simulator.enter_step();
  rig.simulator.exact_work().set_limit(1);
  rig.structure.erase(7);
  EXPECT_THROW(rig.structure.insert(7), WorkLimitReached);
  EXPECT_THROW(rig.structure.erase(8), std::logic_error);
}

}  // namespace
}  // namespace kds::spanner_test
