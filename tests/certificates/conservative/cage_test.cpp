// Conservative tests of cages against the spheres over rationals, densely sampled.
#include <gtest/gtest.h>

#include <cmath>

#include "certificates/conservative/cage_cage.h"
#include "certificates/conservative/cage_in_cage.h"
#include "tests/support/inputs/ball_motions.h"
#include "tests/support/rounds.h"

namespace kds::cage_test {
namespace {

using test::Random;

Rational rational(double x) { return Dyadic(x).rational(); }

template <class M>
std::vector<test::Ball> balls_of(const M& motion, const std::vector<BeadId>& basis, const Dyadic& time) {
  std::vector<test::Ball> balls;
  for (const BeadId b : basis) balls.push_back(test::ball_at(motion, b, time));
  return balls;
}

bool overlaps(const Interval& a, const test::Enclosed& b) {
  return rational(a.lower) <= b.upper && b.lower <= rational(a.upper);
}

/// Two bases of so many beads each, the second around `apart`, shrunk.
template <int Dimension, int Degree>
BezierMotion<Dimension, Degree> two_cages(Random& random, std::size_t first, std::size_t second, double apart,
                                          double shrink, bool equal, double drift) {
  BezierMotion<Dimension, Degree> motion(first + second);
  for (BeadId b = 0; b < first + second; ++b) {
    const bool inner = b >= first;
    const std::size_t place = inner ? b - first : b;
    const double size = inner ? shrink : 1;
    const double radius = equal ? 0.2 : test::uniform(random, 0.05, 0.4);
    for (int k = 0; k <= Degree; ++k) {
      for (int axis = 0; axis < Dimension; ++axis) {
        const double x = test::corners[Dimension - 2][place][axis] + test::uniform(random, -0.15, 0.15);
        const double gone = inner && axis == 0 ? apart + drift * k / Degree : 0;
        motion.set_coordinate(b, k, axis, size * x + gone);
      }
      motion.set_radius(b, k, size * radius * (equal ? 1 : 1 + 0.1 * test::uniform(random)));
    }
  }
  return motion;
}

struct Cages {
  std::vector<BeadId> first, second;
};
Cages cages(std::size_t first, std::size_t second) {
  Cages result;
  for (BeadId b = 0; b < first; ++b) result.first.push_back(b);
  for (BeadId b = 0; b < second; ++b) result.second.push_back(static_cast<BeadId>(first) + b);
  return result;
}

/// Exact places of both spheres at a time; none if one is not there.
struct Places {
  test::RationalPoint apart;  // of the bases' first beads
  test::Ball first_a, first_b;
  test::TouchingSphere a, b;

  [[nodiscard]] test::Enclosed square_distance() const {
    test::Enclosed sum(0);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const test::Enclosed along = test::Enclosed(apart[axis]) + b.center[axis] - a.center[axis];
      sum = sum + along * along;
    }
    return sum;
  }
  [[nodiscard]] test::Enclosed radius_a() const { return a.radius + test::Enclosed(first_a.radius); }
  [[nodiscard]] test::Enclosed radius_b() const { return b.radius + test::Enclosed(first_b.radius); }
  /// 1: b certainly within a; -1: certainly not.
  [[nodiscard]] int within() const {
    const test::Enclosed room = radius_a() - radius_b();
    if (room.sign() < 0) return -1;
    return (room * room - square_distance()).sign();
  }
  [[nodiscard]] int disjoint() const {
    const test::Enclosed reach = radius_a() + radius_b();
    return (square_distance() - reach * reach).sign();
  }
};

template <class M>
std::optional<Places> places_at(const M& motion, const Cages& of, const Dyadic& time) {
  const auto balls_a = balls_of(motion, of.first, time);
  const auto balls_b = balls_of(motion, of.second, time);
  const auto a = test::touching_sphere(balls_a, 120);
  const auto b = test::touching_sphere(balls_b, 120);
  if (!a || !b) return std::nullopt;
  return Places{test::minus(balls_b[0].center, balls_a[0].center), balls_a[0], balls_b[0], *a, *b};
}

template <int Dimension, int Degree>
void expect_spheres(Random& random, bool equal) {
  for (std::size_t size = 1; size <= Dimension + 1; ++size) {
    const auto motion = two_cages<Dimension, Degree>(random, size, 1, 0, 1, equal, 0);
    const Cages of = cages(size, 1);
    const int bits = test::pick(random, 2, 10);
    const double length = std::ldexp(1.0, -bits);
    const double lower = length * test::pick(random, 0, (1 << bits) - 1);
    const auto sphere = cage_sphere(PieceView(motion, lower, lower + length), of.first);
    if (bits >= 7) {
      ASSERT_TRUE(sphere);
    }
    if (!sphere) continue;
    for (int k = 0; k <= 8; ++k) {
      const double u = lower + length * k / 8;
      const auto exact = places_at(motion, of, Dyadic(u));
      ASSERT_TRUE(exact);
      EXPECT_TRUE(overlaps(sphere->radius.range, exact->radius_a()));
      for (std::size_t axis = 0; axis < Dimension; ++axis)
        EXPECT_TRUE(overlaps(sphere->center[axis].range, exact->a.center[axis]));
      if (k == 4) {
        EXPECT_TRUE(overlaps(sphere->radius.middle, exact->radius_a()));
        EXPECT_LT(sphere->radius.middle.upper - sphere->radius.middle.lower, 1e-11);
      }
    }
    if (bits >= 9) {
      EXPECT_LT(sphere->radius.range.upper - sphere->radius.range.lower, 0.05);
    }
  }
}

TEST(CageSphere, HoldsTheSphereThroughItsBasis) {
  Random random(781);
  for (int i = 0; i < 40; ++i) {
    SCOPED_TRACE("seed 781, round " + std::to_string(i));
    expect_spheres<2, 1>(random, i % 2 == 0);
    expect_spheres<3, 1>(random, i % 2 == 0);
    expect_spheres<3, 3>(random, i % 2 == 0);
    if (testing::Test::HasFailure()) return;
  }
}

// The leading coefficient of rho's equation vanishes at u = 1/2 (radical_search_test.cpp).
TEST(CageSphere, PassesTheVanishingOfTheLeadingCoefficient) {
  BezierMotion<2, 1> motion(3);
  for (int k = 0; k <= 1; ++k) {
    motion.set_coordinate(1, k, 0, 5);
    motion.set_coordinate(2, k, 1, 5);
    motion.set_radius(0, k, 5);
    motion.set_radius(1, k, k == 0 ? 2.125 : 1.875);
    motion.set_radius(2, k, 1);
  }
  const std::vector<BeadId> basis{0, 1, 2};
  const auto sphere = cage_sphere(PieceView(motion, 0.49, 0.51), basis);
  ASSERT_TRUE(sphere);
  EXPECT_NEAR(sphere->radius.middle.lower, 5 + 3.37 / 3.36, 1e-9);
}

enum class Question { within, disjoint };

/// What is proved holds; the end of it is not after the first time at which it is seen not to hold.
template <class M>
double expect_never_late(const M& motion, const Cages& of, Question question, double from, int samples) {
  const double until = question == Question::within ? cage_in_cage_until(motion, of.second, of.first, from)
                                                    : cages_disjoint_until(motion, of.first, of.second, from);
  EXPECT_TRUE(until >= from && until <= 1);
  for (int k = 0; k <= samples; ++k) {
    const double u = k == samples ? until : from + (until - from) * k / samples;
    if (u > until || (until == from)) break;
    const auto places = places_at(motion, of, Dyadic(u));
    if (!places) {
      ADD_FAILURE() << "a sphere was proved about that is not there";
      break;
    }
    EXPECT_GE(question == Question::within ? places->within() : places->disjoint(), 0) << "at " << u;
  }
  return until;
}

/// The first of the times at which it does not hold, or 1.
template <class M>
double first_seen_broken(const M& motion, const Cages& of, Question question, double from, int samples) {
  for (int k = 0; k <= samples; ++k) {
    const double u = from + (1 - from) * k / samples;
    const auto places = places_at(motion, of, Dyadic(u));
    if (!places || (question == Question::within ? places->within() : places->disjoint()) < 0) return u;
  }
  return 1;
}

template <int Dimension, int Degree>
void expect_conservative(Random& random, int& broken, double& share) {
  const auto size = [&] { return static_cast<std::size_t>(test::pick(random, 1, Dimension + 1)); };
  for (const Question question : {Question::within, Question::disjoint}) {
    const bool within = question == Question::within;
    const std::size_t a = within ? std::max<std::size_t>(size(), 2) : size();
    const std::size_t b = size();
    const double drift = within ? test::uniform(random, -3, 3) : test::uniform(random, -6, 0);
    const auto motion = two_cages<Dimension, Degree>(random, a, b, within ? 0 : 4, within ? 0.125 : 1,
                                                     random() % 2 == 0, drift);
    const Cages of = cages(a, b);
    const double from = random() % 2 == 0 ? 0 : 0.0625;
    const double until = expect_never_late(motion, of, question, from, 10);
    const double truth = first_seen_broken(motion, of, question, from, 32);
    EXPECT_LE(until, truth);
    if (truth < 1 && truth > from) {
      ++broken;
      share += (until - from) / (truth - from);
    }
    if (truth == 1) {
      EXPECT_GT(until, from);
    }
  }
}

TEST(Cages, AreNeverProvedTooLong) {
  Random random(782);
  int broken = 0;
  double share = 0;
  for (int i = 0; i < test::rounds(60); ++i) {
    SCOPED_TRACE("seed 782, round " + std::to_string(i));
    expect_conservative<2, 1>(random, broken, share);
    expect_conservative<3, 1>(random, broken, share);
    expect_conservative<3, 3>(random, broken, share);
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_GT(broken, test::rounds(60));
  EXPECT_GT(share / broken, 0.8);  // and long enough to be of use
}

// Balls of radius 1 and 1/4 on a line.
BezierMotion<1, 1> on_a_line(double from, double to) {
  BezierMotion<1, 1> motion(2);
  for (int k = 0; k <= 1; ++k) {
    motion.set_coordinate(1, k, 0, k == 0 ? from : to);
    motion.set_radius(0, k, 1);
    motion.set_radius(1, k, 0.25);
  }
  return motion;
}
const std::vector<BeadId> zero{0};
const std::vector<BeadId> one{1};

TEST(Cages, FailInTime) {
  const double leaves = cage_in_cage_until(on_a_line(0, 1.5), one, zero, 0);  // truth: 1/2
  EXPECT_LE(leaves, 0.5);
  EXPECT_GT(leaves, 0.49);
  const double meets = cages_disjoint_until(on_a_line(2.25, 0.25), zero, one, 0);
  EXPECT_LT(meets, 0.5);
  EXPECT_GT(meets, 0.49);
  EXPECT_EQ(cage_in_cage_until(on_a_line(1, 0), one, zero, 0), 0);        // not inside
  EXPECT_EQ(cage_in_cage_until(on_a_line(0, 0), zero, one, 0.25), 0.25);  // the wrong way round
  EXPECT_EQ(cages_disjoint_until(on_a_line(1, 5), zero, one, 0), 0);
  EXPECT_EQ(cages_disjoint_until(on_a_line(1.25, 5), zero, one, 0), 0);  // closed: touching is no gap
}

TEST(Cages, AreProvedAtOnceWhereThereIsRoom) {
  EXPECT_EQ(cage_in_cage_until(on_a_line(-0.5, 0.5), one, zero, 0, 4), 1);
  EXPECT_EQ(cages_disjoint_until(on_a_line(3, 9), zero, one, 0, 1), 1);
  Random random(783);
  for (int i = 0; i < 20; ++i) {
    const auto inside = two_cages<3, 1>(random, 4, 4, 0, 0.0625, i % 2 == 0, 0);
    EXPECT_EQ(cage_in_cage_until(inside, cages(4, 4).second, cages(4, 4).first, 0), 1);
    const auto apart = two_cages<3, 3>(random, 4, 4, 9, 1, i % 2 == 0, 3);
    EXPECT_EQ(cages_disjoint_until(apart, cages(4, 4).first, cages(4, 4).second, 0), 1);
  }
}

TEST(Cages, GiveUpWithinTheirBudget) {
  const auto motion = on_a_line(0, 1.5);
  EXPECT_EQ(cage_in_cage_until(motion, one, zero, 0, 0), 0);
  EXPECT_EQ(cage_in_cage_until(motion, one, zero, 0, 1), 0);  // the whole step is too much
  EXPECT_EQ(cage_in_cage_until(motion, one, zero, 1), 1);
  // A basis that is none: coincident beads, and one ball that holds the other.
  BezierMotion<3, 1> flat(4);
  const std::vector<BeadId> pair{0, 1};
  const std::vector<BeadId> other{2, 3};
  EXPECT_EQ(cages_disjoint_until(flat, pair, other, 0.5), 0.5);
  EXPECT_EQ(cage_in_cage_until(flat, pair, other, 0.5), 0.5);
  for (int k = 0; k <= 1; ++k) {
    flat.set_coordinate(1, k, 0, 1);
    flat.set_radius(0, k, 3);
    flat.set_coordinate(2, k, 0, 100);
  }
  EXPECT_EQ(cages_disjoint_until(flat, pair, std::vector<BeadId>{2}, 0), 0);
}

TEST(Cages, KnowTheLimitsOfDoubles) {
  Random random(784);
  for (const int exponent : {-1000, -300, 300, 1000}) {
    auto motion = two_cages<3, 1>(random, 4, 3, 9, 1, false, -20);
    test::scale(motion, exponent);
    const double until = cages_disjoint_until(motion, cages(4, 3).first, cages(4, 3).second, 0);
    EXPECT_LE(until, first_seen_broken(motion, cages(4, 3), Question::disjoint, 0, 16));
  }
}

}  // namespace
}  // namespace kds::cage_test
