#include "certificates/types/membership.h"

#include <gtest/gtest.h>

#include "certificates/search/define_radical_search.h"
#include "certificates/search/relaxed_sphere_searches.h"
#include "certificates/types/orientation.h"
#include "tests/support/inputs/random_motion.h"
#include "tests/support/judges/enclosing_ball.h"
#include "tests/support/rounds.h"
#include "tests/support/searches.h"

namespace kds::relaxed_membership_test {
namespace {

using test::Ball;
using test::Enclosed;

/// Makes balls of a few sizes that are close to each other.
template <Motion M>
M balls_near(test::Random& random, std::size_t count) {
  M motion(count);
  for (BeadId b = 0; b < count; ++b) {
    const double radius = 0.125 * test::pick(random, 1, 4);
    for (int k = 0; k <= M::degree; ++k) {
      for (int axis = 0; axis < M::dimension; ++axis)
        motion.set_coordinate(b, k, axis,
                              k == 0 ? test::uniform(random)
                                     : motion.coordinate(b, 0, axis) + test::uniform(random, -0.2, 0.2));
      motion.set_radius(b, k, radius);
      motion.set_weight(b, k, radius * radius);
    }
  }
  return motion;
}

struct Seen {
  /// `between` counts balls in the relaxed sphere but not in the sphere itself.
  int relaxed = 0, between = 0, outside = 0;
};

/// Judges the certificate of the last ball by its definition, and checks that a ball for which it holds lies
/// in the sphere of radius (1 + share) R.
template <class Certificate, Motion M>
void judge(const Certificate& certificate, const M& motion, double u, Seen& seen) {
  constexpr std::size_t size = std::tuple_size_v<decltype(Certificate{}.beads)> - 1;
  if constexpr (
      requires { certificate.orientation; } && requires { certificate.beads.relaxation; }) {
    const Dyadic time(u);
    std::vector<Ball> basis;
    for (std::size_t i = 0; i < size; ++i) basis.push_back(test::ball_at(motion, certificate.beads[i], time));
    const Ball ball = test::ball_at(motion, certificate.beads[size], time);
    const auto sphere = test::touching_sphere(basis);
    if (!sphere || !sphere->is_proper()) return;
    for (const Ball& member : basis)
      if (sphere->holds(basis[0], member) < 0) return;
    const Rational share(certificate.beads.relaxation.share());
    const auto d = test::minus(ball.center, basis[0].center);
    Enclosed distance(0);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Enclosed along = sphere->center[axis] - Enclosed(d[axis]);
      distance = distance + along * along;
    }
    Enclosed room = sphere->radius - Enclosed(ball.radius - basis[0].radius);
    Rational tau = 0;
    if constexpr (size == 1) {
      room = room + Enclosed(Rational(share * basis[0].radius));
    } else {
      const auto across = test::minus(basis[1].center, basis[0].center);
      const Rational p = basis[0].radius + basis[1].radius;
      tau = share / 2 * (test::dot(across, across) + p * p - 2 * p * ball.radius);
      ASSERT_GE(tau, 0);
      ASSERT_GE(room.upper, 0);  // the radius condition
    }
    const int expected = room.upper < 0 ? -1 : (room * room + Enclosed(tau) - distance).sign();
    if (expected == 0) return;  // the judge is undecided
    StageCounts stages;
    ++seen.relaxed;
    EXPECT_EQ(test::sign_now(Kernel::exact, certificate, motion, Instant(u), stages), expected);
    EXPECT_EQ(test::sign_now(Kernel::filtered, certificate, motion, Instant(u), stages), expected);
    EXPECT_EQ(test::sign_just_after(Kernel::filtered, certificate, motion, Instant(u), stages), expected);
    const int inside = sphere->holds(basis[0], ball);
    EXPECT_TRUE(inside <= 0 || expected == 1);
    if (expected > 0) {  // inside the sphere of radius (1 + share) R
      const Enclosed reach = sphere->radius +
                             Enclosed(Rational(share)) * (sphere->radius + Enclosed(basis[0].radius)) -
                             Enclosed(Rational(ball.radius - basis[0].radius));
      EXPECT_GE((reach * reach - distance).sign(), 0);
      EXPECT_GE(reach.sign(), 0);
      seen.between += inside < 0 ? 1 : 0;
    } else {
      ++seen.outside;
    }
  }
}

template <Motion M>
Seen judge_random(unsigned seed, std::size_t size) {
  test::Random random(seed);
  Seen seen;
  for (int i = 0; i < test::rounds(3000); ++i) {
    SCOPED_TRACE("seed " + std::to_string(seed) + ", round " + std::to_string(i));
    const M motion = balls_near<M>(random, size + 1);
    const double u = 0.125 * test::pick(random, 0, 7);
    std::array<BeadId, 4> all{};
    for (std::size_t b = 0; b < size; ++b) all[b] = static_cast<BeadId>(b);
    const auto basis = std::span<const BeadId>(all).first(size);
    int orientation = 0;
    if (size == M::dimension + 1) {
      Orientation<M::dimension> turn;
      std::copy_n(basis.begin(), turn.beads.size(), turn.beads.begin());
      orientation = test::sign_at(turn, motion, Dyadic(u));
      if (orientation == 0) continue;
    }
    visit_relaxed_membership(Radii::any, motion, basis, static_cast<BeadId>(size), orientation,
                             Relaxation::of(0.25),
                             [&](const auto& certificate) { judge(certificate, motion, u, seen); });
    if (testing::Test::HasFatalFailure()) return seen;
  }
  return seen;
}

TEST(RelaxedMembership, OfUnequalBallsIsWhatItsDefinitionSays) {
  const auto expect_some = [](const Seen& seen, int least) {
    EXPECT_GT(seen.relaxed, test::rounds(least));
    EXPECT_GT(seen.between, test::rounds(5));
    EXPECT_GT(seen.outside, test::rounds(5));
  };
  expect_some(judge_random<BezierMotion<3, 1>>(751, 2), 100);
  expect_some(judge_random<BezierMotion<3, 1>>(752, 3), 50);
  expect_some(judge_random<BezierMotion<3, 1>>(753, 4), 10);
  expect_some(judge_random<BezierMotion<2, 1>>(754, 2), 100);
  expect_some(judge_random<BezierMotion<2, 1>>(755, 3), 50);
  expect_some(judge_random<BezierMotion<3, 3>>(756, 2), 50);
  const Seen of_one = judge_random<BezierMotion<3, 1>>(757, 1);
  EXPECT_GT(of_one.relaxed, test::rounds(100));
}

// The two beads that are farthest apart come first, and the others keep their order.
TEST(RelaxedMembership, PutsTheFarthestFirst) {
  BezierMotion<3, 1> motion(4);
  const double x[4] = {0, 1, 7, -5};
  for (BeadId b = 0; b < 4; ++b)
    for (int k = 0; k <= 1; ++k) motion.set_coordinate(b, k, 0, x[b]);
  std::array<BeadId, 4> beads{0, 1, 2, 3};
  detail::put_farthest_first(motion, std::span(beads));
  EXPECT_EQ(beads, (std::array<BeadId, 4>{2, 3, 0, 1}));
  EXPECT_EQ(detail::sign_of_order(beads), 1);
  EXPECT_EQ(detail::sign_of_order(std::array<BeadId, 3>{0, 2, 1}), -1);
  EXPECT_LE(detail::least_distance(motion, 2, 3), 12);
  EXPECT_GT(detail::least_distance(motion, 2, 3), 11.999);
}

}  // namespace
}  // namespace kds::relaxed_membership_test
