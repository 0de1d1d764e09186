#include "structures/closest/kinetic_closest_pair.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "structures/closest/candidate_pairs.h"
#include "tests/support/inputs/moving_beads.h"
#include "tests/support/inputs/random_motion.h"
#include "tests/support/judges/moving_points.h"
#include "tests/support/rounds.h"
#include "tests/support/text_of.h"

namespace kds::kinetic_closest_pair_test {
namespace {

using namespace test;
using testing::ElementsAre;
using testing::IsEmpty;

template <Motion M>
using ClosestRig = Rig<KineticClosestPair<M::dimension>, M>;
using Pair = std::array<BeadId, 2>;

second::Integer square_of_distance(const std::vector<second::Integer>& a,
                                   const std::vector<second::Integer>& b) {
  second::Integer sum = 0;
  for (std::size_t axis = 0; axis < a.size(); ++axis) sum += (a[axis] - b[axis]) * (a[axis] - b[axis]);
  return sum;
}

/// Compares the known pair with all pairs; explains a fault, or returns nothing.
template <int Dimension>
std::optional<std::string> fault_of(const KineticClosestPair<Dimension>& closest, const ExactPoints& at) {
  if (at.size() < 2) return closest.pair() ? std::optional("a pair of one bead") : std::nullopt;
  const auto [i, j] = *closest.pair();
  const second::Integer known = square_of_distance(at[i], at[j]);
  for (BeadId a = 0; a < at.size(); ++a)
    for (BeadId b = a + 1; b < at.size(); ++b)
      if (square_of_distance(at[a], at[b]) < known)
        return text_of("beads ", a, " and ", b, " are closer than ", i, " and ", j);
  return std::nullopt;
}

template <Motion M>
History expect_right(const std::vector<M>& steps) {
  return expect_right_at_all_times<KineticClosestPair<M::dimension>>(
      steps, fault_of<M::dimension>, [](const auto& closest) { return closest.pair(); });
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

TEST(KineticClosestPair, ChangesWhereAnotherPairIsAsClose) {
  EXPECT_THAT(told(expect_right(through({{{0, 0, 0}, {2, 0, 0}, {6, 0, 0}},  //
                                         {{0, 0, 0}, {4, 0, 0}, {6, 0, 0}}}))),
              ElementsAre("0 1 to 1 2 at 0.5"));
}

TEST(KineticClosestPair, OfFewBeads) {
  for (const std::size_t beads : {0, 1}) {
    ClosestRig<Space> rig(Space(beads), AuditMode::events);
    rig.run();
    EXPECT_EQ(rig.structure.pair(), std::nullopt);
  }
  EXPECT_THAT(expect_right(through({{{0, 0, 0}, {1, 0, 0}}, {{1, 0, 0}, {0, 0, 0}}})).events, IsEmpty());
}

// Among pairs that are equally close for a whole step, the structure reports the first pair, whichever pair
// was reported before the frame.
TEST(KineticClosestPair, OfPairsEquallyCloseTheFirst) {
  const Points grid{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  Points wide = grid;
  wide[0] = {-1, 0, 0};
  ClosestRig<Space> rig(moving(grid, grid), AuditMode::events);
  rig.run();
  EXPECT_EQ(rig.structure.pair(), (Pair{0, 1}));
  EXPECT_THAT(told(expect_right(through({grid, grid, wide, grid, grid}))),
              ElementsAre("0 1 to 1 3 at 1", "1 3 to 0 1 at 3"));
  const Points together(4, {1, 1, 1});
  EXPECT_THAT(expect_right(through({together, Points(4, {3, 1, 0}), together})).events, IsEmpty());
}

// Whatever happens at one time, the closest pair changes at most once.
TEST(KineticClosestPair, WhereManyMeetItChangesOnce) {
  Points from, to;
  for (int b = 0; b < 6; ++b) {
    from.push_back({1.0 * b * b, 0, 0});
    to.push_back({-1.0 * b * b, 0, 0});
  }
  EXPECT_THAT(told(expect_right<Space>({moving(from, to)})), IsEmpty());
  // Pairs of different lengths all reach other lengths at once.
  Points rows, mirrored;
  for (int b = 0; b < 6; ++b) {
    rows.push_back({10.0 * b, 0, 0});
    rows.push_back({10.0 * b, 1.0 + b, 0});
    mirrored.push_back({10.0 * b, 0, 0});
    mirrored.push_back({10.0 * b, 6.0 - b, 0});
  }
  EXPECT_THAT(told(expect_right<Space>({moving(rows, mirrored)})), ElementsAre("0 1 to 10 11 at 0.5"));
}

template <Motion M>
void try_random_motions(unsigned seed) {
  Random random(seed);
  for (int round = 0; round < test::rounds(5); ++round) {
    for (const MotionKind kind : all_motion_kinds) {
      SCOPED_TRACE(text_of("kind ", static_cast<int>(kind), ", round ", round));
      expect_right(random_steps<M>(random, 1 + random() % 8, kind, 3));
      if (testing::Test::HasFailure()) return;
    }
  }
}
TEST(KineticClosestPair, RandomMotionsInThePlane) { try_random_motions<BezierMotion<2, 1>>(2); }
TEST(KineticClosestPair, RandomMotionsInSpace) { try_random_motions<BezierMotion<3, 1>>(3); }
TEST(KineticClosestPair, RandomCurvesInThePlane) { try_random_motions<BezierMotion<2, 3>>(4); }
TEST(KineticClosestPair, RandomCurvesInSpace) { try_random_motions<BezierMotion<3, 3>>(5); }

TEST(KineticClosestPair, Instances) {
  EXPECT_GT(
      told(expect_right<BezierMotion<2, 1>>({instance_motion<BezierMotion<2, 1>>("d2_n20_linear")})).size(),
      3U);
  std::vector<const char*> degenerate{"converge", "gridint", "gridrigid", "half"};
  degenerate.resize(rounds(4U));
  for (const char* name : degenerate) {
    SCOPED_TRACE(name);
    expect_right<BezierMotion<2, 1>>(
        {instance_motion<BezierMotion<2, 1>>(text_of("degenerate_d2_n64_", name))});
  }
}

TEST(KineticClosestPair, OfAProteinThatTurnsLittleFewPairsAreLookedAt) {
  const auto steps = trajectory_steps("villin_hp36_300K.dcd", 0, 2);
  EXPECT_GT(told(expect_right(steps)).size(), 0U);
  for (const Space& step : steps) EXPECT_LT(candidate_pairs(Curves<3>(step)).size(), 20 * step.bead_count());
}

/// Checks at several times that no pair left out of the candidates is among the closest pairs.
template <Motion M>
void expect_the_closest_among_candidates(const M& motion) {
  const auto candidates = candidate_pairs(Curves<M::dimension>(motion));
  ASSERT_TRUE(std::is_sorted(candidates.begin(), candidates.end()));
  for (const double u : {0.0, 0.125, 0.5, 0.75, 1.0}) {
    const ExactPoints at = points_at(motion, second::Rational(u));
    std::optional<second::Integer> least;
    std::vector<Pair> closest;  // all pairs that tie
    for (BeadId a = 0; a < at.size(); ++a) {
      for (BeadId b = a + 1; b < at.size(); ++b) {
        const second::Integer square = square_of_distance(at[a], at[b]);
        if (!least || square < *least) closest.clear();
        if (closest.empty()) least = square;
        if (square == *least) closest.push_back({a, b});
      }
    }
    for (const Pair& pair : closest)
      ASSERT_TRUE(std::binary_search(candidates.begin(), candidates.end(), pair))
          << pair[0] << ' ' << pair[1];
  }
}

TEST(KineticClosestPair, NoPairIsLeftOutThatMayBeTheClosest) {
  Random random(9);
  for (int round = 0; round < test::rounds(40); ++round) {
    for (const MotionKind kind : all_motion_kinds) {
      SCOPED_TRACE(text_of("kind ", static_cast<int>(kind), ", round ", round));
      expect_the_closest_among_candidates(random_motion<BezierMotion<2, 3>>(random, 2 + random() % 10, kind));
      if (testing::Test::HasFailure()) return;
    }
  }
}

/// Distances that differ only in their last bits, of beads that rest or nearly rest and lie along the axes or
/// nearly so. Rounding errors would decide which pair is the closest. The scales include underflow of low
/// bits, and overflow of differences and sums.
TEST(KineticClosestPair, NoPairIsLeftOutByRounding) {
  Random random(10);
  for (const int exponent : {0, -1060, -1022, 1022}) {
    for (int round = 0; round < test::rounds(150); ++round) {
      SCOPED_TRACE(text_of("times 2^", exponent, ", round ", round));
      BezierMotion<3, 1> motion(8);
      const double shift = pick(random, 0, 2) * 0x1p-53;
      for (BeadId b = 0; b < 8; ++b) {
        for (int axis = 0; axis < 3; ++axis) {
          const double at = axis == 0 ? b / 2 * 0.375 + b % 2 : pick(random, 0, 1) * 0x1p-53;
          for (int k = 0; k <= 1; ++k) {
            const double bits = (pick(random, -2, 2) + shift) * 0x1p-53;
            motion.set_coordinate(b, k, axis, std::ldexp(at + bits, exponent));
          }
        }
      }
      expect_the_closest_among_candidates(motion);
      if (testing::Test::HasFailure()) return;
    }
  }
}

TEST(KineticClosestPair, AuditsNoticeAPairThatIsNotTheClosest) {
  ClosestRig<Space> rig(moving({{0, 0, 0}, {1, 0, 0}, {3, 0, 0}}, {{0, 0, 0}, {1, 0, 0}, {3, 0, 0}}));
  rig.run();
  EXPECT_EQ(rig.structure.audit(Dyadic(0.5)), std::nullopt);
  rig.structure.apply({KineticClosestPair<3>::replace, 4, {0, 1, 1, 2}});
  for (const double time : {0.0, 0.5, 1.0}) EXPECT_NE(rig.structure.audit(Dyadic(time)), std::nullopt);
}

TEST(KineticClosestPair, RefusesChangesThatCannotBe) {
  ClosestRig<Space> rig(moving({{0, 0, 0}, {1, 0, 0}, {3, 0, 0}}, {{0, 0, 0}, {1, 0, 0}, {3, 0, 0}}));
  rig.run();
  for (const std::uint8_t kind : {0, 1}) {
    EXPECT_THROW(rig.structure.apply({kind, 4, {0, 1, 2, 3}}), std::invalid_argument);
    EXPECT_THROW(rig.structure.apply({kind, 4, {0, 1, 2, 1}}), std::invalid_argument);
  }
  EXPECT_THROW(rig.structure.apply({1, 4, {0, 2, 1, 2}}), std::invalid_argument);
  EXPECT_EQ(rig.structure.pair(), (Pair{0, 1}));
}

}  // namespace
}  // namespace kds::kinetic_closest_pair_test
