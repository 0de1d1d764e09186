#include "structures/chord_cages/tight_cages.h"

#include <gmock/gmock.h>

#include "structures/chord_cages/chord_hierarchy.h"
#include "structures/enclosing_sphere/enclosing_sphere.h"
#include "tests/support/inputs/moving_beads.h"
#include "tests/support/inputs/random_motion.h"
#include "tests/support/judges/cages_hold.h"
#include "tests/support/judges/enclosing_ball.h"
#include "tests/support/rounds.h"

namespace kds::tight_cages_test {
namespace {

using namespace test;

/// Returns a lower bound of the radius of the smallest sphere around some beads at a time, usually the radius
/// itself. The basis is found from rounded positions and its sphere is then solved exactly.
template <Motion M>
std::optional<Rational> least_radius(const M& motion, const BeadRange& range, const Dyadic& time) {
  constexpr int d = M::dimension;
  const double u = time.round_down();
  std::vector<double> radii = approximate_radii(motion, u);
  for (double& r : radii) r = std::max(r, 0.0);
  const SmallestSphere found =
      smallest_sphere(Balls<d>(approximate_positions(motion, u), radii), range.first, range.last);
  std::vector<Ball> basis;
  for (const BeadId b : found.basis) basis.push_back(ball_at(motion, b, time));
  if (basis.size() == 1) return basis[0].radius;
  const auto sphere = touching_sphere(basis);
  // Returns nothing if the basis of the rounded positions is not proper at the exact positions.
  if (!sphere || !sphere->is_proper()) return std::nullopt;
  return basis[0].radius + sphere->radius.lower;
}

struct Counts {
  std::uint64_t bisections = 0, unproved = 0, compared = 0;
};

/// Checks all nodes at random exact times: beads are inside, and radii are within the tightness.
template <Motion M>
void expect_tight(const M& motion, double tightness, Random& random, int times, Counts& counts) {
  constexpr int d = M::dimension;
  const Curves<d> curves(motion);
  const std::vector<BeadRange> necklace{{0, static_cast<BeadId>(motion.bead_count() - 1)}};
  ChordCages<StaticWrappedHierarchy<d>> cages(necklace, M::degree, true);
  cages.move_to(curves);
  TightCages<d> tight(tightness);
  tight.prove(cages, curves);
  counts.bisections += tight.bisections();
  counts.unproved += tight.unproved();
  for (NodeId node = 0; node < cages.tree().node_count(); ++node) {
    const BeadRange& range = cages.tree().range(node);
    std::vector<CagePiece<d>> parts(tight.parts(node).begin(), tight.parts(node).end());
    if (parts.empty()) {
      parts.emplace_back();
      for (int k = 0; k <= cages.degree(); ++k) parts.back().cages.push_back(cages.cages(k)[node]);
    }
    double reached = 0;
    for (const CagePiece<d>& part : parts) {
      ASSERT_EQ(part.from, reached);
      reached = part.to;
      for (int i = 0; i < times; ++i) {
        const Dyadic within(i == 0 ? 0.0 : i == 1 ? 1.0 : uniform(random, 0, 1));
        const Rational of_step = part.from + within.rational() * Rational(part.to - part.from);
        ASSERT_EQ(sticks_out<d>(motion, range, part.cages, of_step, within.rational()), std::nullopt);
        const Dyadic time(Integer(numerator(of_step)),
                          static_cast<unsigned>(bit_length(denominator(of_step)) - 1));
        const auto least = least_radius(motion, range, time);
        if (!least) continue;
        ++counts.compared;
        ASSERT_LE(sphere_of<d>(part.cages, within.rational()).radius, *least * (1 + Rational(tightness)))
            << "beads " << range.first << "-" << range.last << " from " << part.from << " to " << part.to;
      }
    }
    ASSERT_EQ(reached, 1);
  }
}

template <class M>
class TightCagesIn : public testing::Test {};
using Motions =
    testing::Types<BezierMotion<2, 1>, BezierMotion<3, 1>, BezierMotion<2, 3>, BezierMotion<3, 3>>;
TYPED_TEST_SUITE(TightCagesIn, Motions);

TYPED_TEST(TightCagesIn, RadiiAreWithinTheTightnessAtRandomExactTimes) {
  Random random(11);
  Counts counts;
  for (int round = 0; round < rounds(12); ++round) {
    auto motion =
        random_motion<TypeParam>(random, 12, round % 3 == 0 ? MotionKind::cospherical : MotionKind::generic);
    for (BeadId b = 0; b < 12 && round % 2 == 0; ++b)
      for (int k = 0; k <= TypeParam::degree; ++k) motion.set_radius(b, k, 0.1);
    if (round % 4 >= 2) {  // calm: all beads stay near their start
      for (BeadId b = 0; b < 12; ++b)
        for (int k = 1; k <= TypeParam::degree; ++k)
          for (int axis = 0; axis < TypeParam::dimension; ++axis)
            motion.set_coordinate(b, k, axis,
                                  motion.coordinate(b, 0, axis) + 0.05 * motion.coordinate(b, k, axis));
    }
    if (round % 8 == 7) scale(motion, round % 16 == 7 ? 90 : -90);
    expect_tight(motion, round % 3 == 0 ? 0.2 : round % 3 == 1 ? 0.01 : 0.001, random, 5, counts);
    ASSERT_FALSE(this->HasFatalFailure()) << "round " << round;
  }
  EXPECT_GT(counts.bisections, rounds(40U));
  EXPECT_EQ(counts.unproved, 0U);
  EXPECT_GT(counts.compared, rounds(1000U));
}

// Two points meet in the middle. No part of the step around that time can be proved tight, and the structure
// counts such parts as unproved.
TEST(TightCages, SaysWhatIsNotProved) {
  const Space meeting = moving({{0, 0, 0}, {1, 0, 0}}, {{1, 0x1p-20, 0}, {0, 0, 0}});
  Random random(12);
  Counts counts;
  expect_tight(meeting, 0.01, random, 3, counts);
  EXPECT_EQ(counts.unproved, 0U) << "they pass each other at a distance";
  EXPECT_GT(counts.bisections, 20U);
  const Space through = moving({{0, 0, 0}, {1, 0, 0}}, {{2, 0, 0}, {0, 0, 0}});
  const std::vector<BeadRange> pair{{0, 1}};
  ChordCages<StaticWrappedHierarchy<3>> cages(pair, 1, true);
  cages.move_to(Curves<3>(through));
  TightCages<3> tight(0.01);
  tight.prove(cages, Curves<3>(through));
  EXPECT_GT(tight.unproved(), 0U) << "at a third of the step the smallest radius is zero";
  EXPECT_LT(tight.bisections(), 4U * TightCages<3>::most_halvings);
}

// A rigid translation needs no bisection; a quarter turn needs a few.
TEST(TightCages, HalvesWhatTurns) {
  Random random(13);
  Counts calm, turning;
  Points from(30), along(30), around(30);
  for (std::size_t b = 0; b < 30; ++b) {
    for (double& x : from[b]) x = uniform(random, -5, 5);
    along[b] = {from[b][0] + 3, from[b][1] - 20, from[b][2]};
    around[b] = {-from[b][1], from[b][0], from[b][2]};
  }
  expect_tight(moving(from, along), 1e-5, random, 3, calm);
  EXPECT_EQ(calm.bisections, 0U);
  expect_tight(moving(from, around), 0.01, random, 3, turning);
  EXPECT_GT(turning.bisections, 29U);
}

TEST(TightCages, CountsInARun) {
  const std::vector<Space> steps = trajectory_steps("villin_hp36_300K.dcd", 0, 6, 3);
  const std::vector<BeadRange> necklace{{0, static_cast<BeadId>(steps.front().bead_count() - 1)}};
  using Structure = ChordHierarchy<StaticWrappedHierarchy<3>>;
  Rig<Structure, Space> rig(steps.front(), AuditMode::frames, necklace, std::optional(0.0005));
  rig.run(steps);
  EXPECT_GT(rig.structure.statistics.events_by_kind[Structure::bisection], 0U);
  EXPECT_EQ(rig.structure.statistics.events_by_kind[Structure::unproved], 0U);
  EXPECT_EQ(rig.external_events(), 0U);
  EXPECT_TRUE(rig.history.events.empty());
  using Layered = ChordHierarchy<LayeredHierarchy<3>>;
  EXPECT_THROW((Rig<Layered, Space>(steps.front(), AuditMode::none, necklace, std::optional(0.1))),
               std::invalid_argument);
}

}  // namespace
}  // namespace kds::tight_cages_test
