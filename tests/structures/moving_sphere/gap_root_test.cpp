// Times at which balls cross spheres, as paths of spheres prove them, compared with radical certificates in
// integers.

#include "structures/moving_sphere/gap_root.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "certificates/exact/exact_time.h"
#include "certificates/types/membership.h"
#include "certificates/types/orientation.h"
#include "motions/curves/positions.h"
#include "structures/enclosing_sphere/enclosing_sphere.h"
#include "tests/support/inputs/moving_beads.h"
#include "tests/support/inputs/polynomial_source.h"
#include "tests/support/inputs/random_motion.h"
#include "tests/support/judges/integer_search.h"

namespace kds::gap_root_test {
namespace {

using namespace test;

struct Tally {
  int asked = 0, never = 0, later = 0, never_again = 0, again = 0, signs = 0;
};

/// Calls `visit` with the certificate if it is radical.
template <class M, class Visit>
void visit_radical(const M& motion, const Basis& basis, BeadId bead, bool inside, const Instant& now,
                   Visit visit) {
  int orientation = 0;
  if (basis.size == M::dimension + 1) {
    Orientation<M::dimension> certificate;
    std::copy(basis.begin(), basis.end(), certificate.beads.begin());
    orientation = integer_sign_just_after(certificate, motion, now);
  }
  visit_membership(Radii::any, motion, std::span(basis.begin(), basis.end()), bead, inside, orientation,
                   [&]<class C>(const C& certificate) {
                     if constexpr (RadicalCertificateFor<C, M>) visit(certificate);
                   });
}

/// Checks that the times are equal and that the bracket contains no other root of the norm.
void expect_same_time(const ExactPolynomial& function, const FailureTime& ours, const FailureTime& exact) {
  ASSERT_LT(ours.lower, ours.upper);
  const ExactPolynomial simple = function.square_free();
  ASSERT_EQ(isolate_roots(simple, Dyadic(ours.lower), Dyadic(ours.upper)).size(), 1U);
  ASSERT_EQ(function.sign_at(Dyadic(ours.lower)) * function.sign_at(Dyadic(ours.upper)), -1);
  ExactTime a = exact_time(function, ours), b = exact_time(function, exact);
  EXPECT_EQ(ExactTime::compare(a, b), 0);
}

/// Judges all claims about a bead and a sphere, from a given time on and from the time of the failure on.
template <class M>
void judge(const M& motion, const BeadPaths<M::dimension>& paths, const Basis& basis, BeadId bead,
           bool inside, double from, Tally& tally) {
  GapRoots<M::dimension> crossings;
  visit_radical(motion, basis, bead, inside, Instant(from), [&]<class C>(const C& certificate) {
    ++tally.asked;
    const auto ours = crossings.first_failure(paths, basis, bead, inside, from, from, false);
    if (!ours) return;
    const Failure exact = integer_first_failure(certificate, motion, Instant(from));
    ASSERT_EQ(ours->kind, exact.kind);
    ++(ours->kind == Failure::Kind::never ? tally.never : tally.later);
    if (ours->kind == Failure::Kind::never) return;
    const ExactPolynomial function = *search_for(certificate, motion)->exact_function(certificate);
    ASSERT_NO_FATAL_FAILURE(expect_same_time(function, ours->time, exact.time));

    // Just after the failure, the bead lies on the other side.
    PolynomialSource source;
    source.add(function.scaled(), {});
    const Instant now(ours->time, source, 0);
    C opposite = certificate;
    opposite.inside = !inside;
    const auto next = crossings.first_failure(paths, basis, bead, !inside, now.lower(), now.upper(), true);
    if (!next) return;
    const Failure exact_next = integer_first_failure(opposite, motion, now, KnownAtStart::at_own_root);
    ASSERT_EQ(next->kind, exact_next.kind);
    ++(next->kind == Failure::Kind::never ? tally.never_again : tally.again);
    if (next->kind == Failure::Kind::later) expect_same_time(function, next->time, exact_next.time);
  });
}

/// Judges the claimed signs at four times, each the start of a period in which the sphere is known.
template <class M>
void judge_signs(Random& random, const M& motion, const BeadPaths<M::dimension>& paths, const Basis& basis,
                 BeadId bead, double from, Tally& tally) {
  std::array<double, 4> times{};
  std::array<Period, 4> periods;
  for (std::size_t i = 0; i < 4; ++i) {
    times[i] = i == 0 ? from : uniform(random, from, 1);
    periods[i] = {times[i], std::min(1.0, times[i] + 0x1p-20)};
  }
  SphereEnclosure<M::dimension> sphere;
  find_motion(paths, basis, periods, sphere);
  GapsAt at;
  find_gaps_at(paths, basis, bead, 1, times, at);
  for (std::size_t i = 0; i < 4; ++i) {
    if ((sphere.proved & at.proved & 1U << i) == 0 || !(std::abs(at.value[i]) > at.loss[i])) continue;
    const Instant now(times[i]);
    visit_radical(motion, basis, bead, true, now, [&](const auto& certificate) {
      ++tally.signs;
      EXPECT_EQ(at.value[i] > 0 ? 1 : -1, integer_sign_now(certificate, motion, now))
          << "bead " << bead << " at " << times[i];
    });
  }
}

template <class M>
void judge_all(unsigned seed, MotionKind kind, int exponent, Tally& tally) {
  SCOPED_TRACE(testing::Message() << "seed " << seed << ", kind " << static_cast<int>(kind));
  Random random(1000 * seed + static_cast<unsigned>(kind));
  auto motion = random_motion<M>(random, 4 + random() % 6, kind);
  const double pace = std::ldexp(1.0, -static_cast<int>(seed % 7));
  const auto count = static_cast<BeadId>(motion.bead_count());
  for (BeadId b = 0; b < count; ++b) {
    const double radius = uniform(random, 0.1, 0.3), growth = seed % 3 == 0 ? uniform(random) * 0.1 : 0;
    for (int k = 0; k <= 1; ++k) {
      for (int axis = 0; axis < M::dimension; ++axis) {
        const double start = motion.coordinate(b, 0, axis);
        motion.set_coordinate(b, k, axis, start + pace * (motion.coordinate(b, k, axis) - start));
      }
      motion.set_radius(b, k, radius + k * growth);
      motion.set_weight(b, k, 0);
    }
  }
  scale(motion, exponent);
  BeadPaths<M::dimension> paths;
  paths.set(Curves<M::dimension>(motion));
  const double from = seed % 2 == 0 ? 0 : uniform(random, 0, 0.9);
  const Balls<M::dimension> balls(approximate_positions(motion, from), approximate_radii(motion, from));
  const Basis basis = smallest_sphere(balls, 0, count - 1).basis;
  if (basis.size < 2) return;
  for (BeadId b = 0; b < count; ++b) {
    if (!basis.contains(b)) {
      judge(motion, paths, basis, b, true, from, tally);
      judge_signs(random, motion, paths, basis, b, from, tally);
    } else if (basis.size > 2) {
      judge(motion, paths, without(basis, b), b, false, from, tally);
    }
    if (testing::Test::HasFatalFailure()) return;
  }
}

TEST(SphereCrossing, IsWhenRadicalCertificatesFail) {
  Tally space, plane;
  for (unsigned seed = 0; seed < 150U; ++seed) {
    judge_all<Space>(seed, MotionKind::generic, 0, space);
    judge_all<BezierMotion<2, 1>>(seed, MotionKind::generic, 0, plane);
  }
  for (const Tally& tally : {space, plane}) {
    EXPECT_GT(tally.never + tally.later, tally.asked / 2);
    EXPECT_GT(tally.never, 100);
    EXPECT_GT(tally.later, 50);
    EXPECT_GT(tally.never_again, 25);
    EXPECT_GT(tally.again, 2);
    EXPECT_GT(tally.signs, 500);
  }
}

// Bases whose centre moves by more than the radius changes.
TEST(SphereCrossing, OfNearlyFlatBases) {
  Tally tally;
  int steep = 0;
  const Basis basis(std::array<BeadId, 4>{0, 1, 2, 3});
  for (unsigned seed = 0; seed < 200U; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random(seed);
    const double height = std::ldexp(1.0, -static_cast<int>(1 + seed % 6));
    const double pace = height * std::ldexp(1.0, -static_cast<int>(seed % 5));
    const auto motion = nearly_flat_basis<Space>(random, 6, height, pace);
    BeadPaths<3> paths;
    paths.set(Curves<3>(motion));
    SphereEnclosure<3> sphere;
    find_motion(paths, basis, {Period{0, 0x1p-20}, {0, 0.1}, {0, 0.5}, {0, 1}}, sphere);
    const double square =
        std::inner_product(sphere.q.begin(), sphere.q.end(), sphere.q.begin(), 0.0, std::plus<>(),
                           [](const auto& a, const auto& b) { return a[0] * b[0]; });
    steep += square > 1 && (sphere.proved & 1U) != 0 ? 1 : 0;
    for (const BeadId bead : {4U, 5U}) {
      judge(motion, paths, basis, bead, true, 0, tally);
      judge_signs(random, motion, paths, basis, bead, 0, tally);
    }
    for (const BeadId bead : basis) judge(motion, paths, without(basis, bead), bead, false, 0, tally);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(steep, 50);
  EXPECT_GT(tally.never, 300);
  EXPECT_GT(tally.later, 100);
  EXPECT_GT(tally.never_again, 50);
  EXPECT_GT(tally.signs, 500);
}

TEST(SphereCrossing, OfDegenerateMotions) {
  Tally tally;
  for (unsigned seed = 0; seed < 12; ++seed) {
    for (const MotionKind kind : all_motion_kinds) judge_all<Space>(seed, kind, 0, tally);
  }
  EXPECT_GT(tally.never, 50);
  EXPECT_GT(tally.later, 10);
}

TEST(SphereCrossing, ScalesWithTheInput) {
  for (const int exponent : {-300, -140, 140, 300}) {
    Tally tally;
    for (unsigned seed = 0; seed < 12; ++seed) judge_all<Space>(seed, MotionKind::generic, exponent, tally);
    EXPECT_EQ(tally.never + tally.later > 10, std::abs(exponent) <= 140) << exponent;
    EXPECT_EQ(tally.never + tally.later == 0, std::abs(exponent) > 140) << exponent;
  }
}

// A pair turns and is shortest in the middle of the step. The sphere of the basis cuts a third ball there by
// less than the rounding error.
TEST(SphereCrossing, TouchesAreLeftToIntegers) {
  const Points from{{-2, -1, 0}, {2, 1, 0}, {0, 2, 0}}, to{{-2, 1, 0}, {2, -1, 0}, {0, 2, 0}};
  Space motion = moving(from, to);
  for (int k = 0; k <= 1; ++k) {
    motion.set_radius(0, k, 0.25);
    motion.set_radius(1, k, 0.25);
    motion.set_radius(2, k, 0.25 + 0x1p-50);
  }
  BeadPaths<3> paths;
  paths.set(Curves<3>(motion));
  GapRoots<3> crossings;
  const Basis pair(std::array<BeadId, 2>{0, 1});
  EXPECT_FALSE(crossings.first_failure(paths, pair, 2, true, 0, 0, false).has_value());
}

// Judges the claimed signs at the ends of a period next to the root of a ball that flies by at any speed.
TEST(SphereCrossing, SignsOfAFastBall) {
  std::mt19937_64 random(5);
  const auto uniform = [&] { return 0.3 + 0.7 * static_cast<double>(random() >> 11U) * 0x1p-53; };
  for (const int exponent : {4, 12, 16, 24, 30}) {
    int claimed = 0;
    for (int trial = 0; trial < 3000; ++trial) {
      const double from_x = -std::ldexp(uniform(), exponent), to_x = std::ldexp(uniform(), exponent);
      const Points start{{0, -1, 0}, {0, 1, 0}, {from_x, 0, 0}}, end{{0, -1, 0}, {0, 1, 0}, {to_x, 0, 0}};
      Space motion = moving(start, end);
      const std::array radii{0.25, 0.3, 0.125};
      for (BeadId b = 0; b < 3; ++b)
        for (int k = 0; k <= 1; ++k) motion.set_radius(b, k, radii[b]);
      BeadPaths<3> paths;
      paths.set(Curves<3>(motion));
      // The pair's sphere is at rest, with radius R and centre (0, y, 0).
      const Rational radius = (Rational(2) + Rational(0.25) + Rational(0.3)) / 2;
      const Rational y = radius - Rational(0.25) - 1, room = radius - Rational(0.125);
      const auto sign_of_gap = [&](double u) {
        const Rational x = (1 - Rational(u)) * Rational(from_x) + Rational(u) * Rational(to_x);
        const Rational left = room * room - x * x - y * y;
        return left > 0 ? 1 : left < 0 ? -1 : 0;
      };
      const double half = std::sqrt(Rational(room * room - y * y).get_d());
      const double root = (-half - from_x) / (to_x - from_x);
      const double from = root + (static_cast<double>(random() % 5) - 2) * 0x1p-54, to = from + 0x1p-37;
      SphereEnclosure<3> sphere;
      const Period period{from, to};
      find_motion(paths, Basis(std::array<BeadId, 2>{0, 1}), {period, period, period, period}, sphere);
      if ((sphere.proved & 1U) == 0) continue;
      SphereGaps gaps;
      find_gaps(paths, sphere, 0, 2, -1, gaps);
      for (const std::size_t e : {0U, 1U}) {
        const double gap = gaps.at_end[e][0];
        if (!(std::abs(gap) > gaps.loss_at_ends[0])) continue;
        ++claimed;
        ASSERT_EQ(gap > 0 ? 1 : -1, -sign_of_gap(e == 0 ? from : to)) << from_x << ' ' << to_x << ' ' << from;
      }
      const std::array<double, 4> times{from, to, root, root + 0x1p-45};
      GapsAt at;
      find_gaps_at(paths, Basis(std::array<BeadId, 2>{0, 1}), 2, 1, times, at);
      for (std::size_t i = 0; i < 4; ++i) {
        if ((at.proved >> i & 1U) == 0 || !(std::abs(at.value[i]) > at.loss[i])) continue;
        ASSERT_EQ(at.value[i] > 0 ? 1 : -1, sign_of_gap(times[i]))
            << from_x << ' ' << to_x << ' ' << times[i];
      }
    }
    // The signs of slow balls are known at some ends; the signs of fast balls are not known next to the root.
    if (exponent <= 16) {
      EXPECT_GT(claimed, 100) << exponent;
    }
  }
}

}  // namespace
}  // namespace kds::gap_root_test
