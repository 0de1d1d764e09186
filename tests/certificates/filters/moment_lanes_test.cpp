// Four orientations are reported as positive at a moment only if each of them is positive throughout its
// bracket, judged in integers.

#include "certificates/filters/formula_lanes.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "certificates/types/orientation.h"
#include "motions/curves/lifted_motion.h"
#include "tests/support/inputs/random_motion.h"
#include "tests/support/judges/rational_geometry.h"
#include "tests/support/rounds.h"

namespace kds::moment_lanes_test {
namespace {

template <Motion M>
void compare(std::uint64_t least_found) {
  constexpr int dimension = M::dimension;
  using Function = Orientation<dimension>;
  test::Random random(91);
  std::uint64_t found = 0, looked_at = 0;
  for (int round = 0; round < test::rounds(200); ++round) {
    for (const test::MotionKind kind : test::all_motion_kinds) {
      const M motion = test::random_motion<M>(random, dimension + 1, kind);
      const Dyadic time = test::random_dyadic(random);
      const double lower = time.round_down();
      const double upper = lower + std::ldexp(test::uniform(random) * 0.5 + 0.5, round % 2 == 0 ? -40 : -28);
      for (const int side : {1, -1}) {
        decltype(Function{}.beads) beads{};
        for (std::size_t b = 0; b < beads.size(); ++b) beads[b] = static_cast<BeadId>(b);
        bool positive = true;
        positive_at_moment<Function>(motion, {beads, beads, beads, beads}, Lanes(side), lower, upper,
                                     positive);
        ++looked_at;
        if (!positive) continue;
        ++found;
        for (const double u : {lower, 0.5 * (lower + upper), upper})
          EXPECT_EQ(test::sign_at(Function(beads, side), motion, Dyadic(u)), 1);
      }
    }
  }
  EXPECT_GT(found, test::rounds(least_found)) << "of " << looked_at;
}

TEST(MomentLanes, SeeWhatIsPositive) {
  compare<BezierMotion<3, 1>>(300);
  compare<BezierMotion<2, 1>>(300);
  compare<BezierMotion<3, 3>>(300);
  compare<LiftedMotion<3>>(300);
}

// A flat cell opens: near zero nothing wrong may be claimed.
TEST(MomentLanes, ClaimNothingNextToZero) {
  test::Random random(92);
  std::uint64_t found = 0;
  for (int places = 2; places < 60; ++places) {
    for (int round = 0; round < 40; ++round) {
      BezierMotion<3, 1> motion(4);
      for (BeadId b = 0; b < 4; ++b) {
        for (int k = 0; k < 2; ++k) {
          for (int axis = 0; axis < 2; ++axis) motion.set_coordinate(b, k, axis, test::uniform(random));
          motion.set_coordinate(b, k, 2, 7 + std::ldexp(test::uniform(random), -places));
        }
      }
      bool positive = true;
      const std::array<BeadId, 4> beads{0, 1, 2, 3};
      positive_at_moment<Orientation<3>>(motion, {beads, beads, beads, beads}, Lanes(1.0), 0.25,
                                         0.25 + 0x1p-40, positive);
      if (!positive) continue;
      ++found;
      EXPECT_EQ(test::sign_at(Orientation<3>(beads, 1), motion, Dyadic(0.25)), 1);
      EXPECT_EQ(test::sign_at(Orientation<3>(beads, 1), motion, Dyadic(0.25 + 0x1p-40)), 1);
      EXPECT_LT(places, 26);  // floats cannot resolve smaller openings
    }
  }
  EXPECT_GT(found, test::rounds(100U));
}

// The answer is false if any one of the four orientations is not positive, or if any bracket is too wide.
TEST(MomentLanes, SpeakForAllFour) {
  const std::vector<std::array<double, 3>> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const auto motion = test::at_rest(corners);
  const std::array<BeadId, 4> right{0, 1, 2, 3}, wrong{1, 0, 2, 3};
  const auto answer = [&](const auto& tuples, const Lanes& sides, double upper) {
    bool positive = false;
    positive_at_moment<Orientation<3>>(motion, tuples, sides, 0.5, upper, positive);
    return positive;
  };
  EXPECT_TRUE(answer(std::array{right, right, right, right}, Lanes(1.0), 0.5));
  EXPECT_TRUE(answer(std::array{wrong, wrong, wrong, wrong}, Lanes(-1.0), 0.5));
  EXPECT_FALSE(answer(std::array{right, right, right, right}, Lanes(1.0), 0.5 + 0x1p-20));
  for (std::size_t lane = 0; lane < 4; ++lane) {
    std::array tuples{right, right, right, right};
    tuples[lane] = wrong;
    EXPECT_FALSE(answer(tuples, Lanes(1.0), 0.5));
    Lanes sides(1.0);
    sides.v[lane] = -1;
    EXPECT_TRUE(answer(tuples, sides, 0.5));
  }
}

}  // namespace
}  // namespace kds::moment_lanes_test
