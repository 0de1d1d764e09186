#include "tests/support/searches.h"

#include <gtest/gtest.h>

#include <cmath>

#include "certificates/types/bead_in_sphere.h"
#include "certificates/types/power_test.h"
#include "tests/support/inputs/ball_motions.h"
#include "tests/support/judges/judged_failure.h"
#include "tests/support/rounds.h"

namespace kds::radical_search_test {
namespace {

namespace sturm = test::sturm;
using test::BallCase;
using test::BallShape;
using test::JudgedFailure;
using test::JudgedTime;
using test::Random;
using Kind = Failure::Kind;

TEST(Radicals, HaveTheSignOfTheGreaterPart) {
  for (int a = -3; a <= 3; ++a) {
    for (int b = -3; b <= 3; ++b) {
      for (int d = 0; d <= 9; ++d) {
        const double value = a + b * std::sqrt(d);
        const int expected = (value > 1e-9) - (value < -1e-9);
        const auto sign = [](int x) { return (x > 0) - (x < 0); };
        EXPECT_EQ(sign_of_radical(sign(a), sign(b), sign(a * a - b * b * d)), expected);
        // If one of the signs is unknown, the function must not guess.
        for (const int guess :
             {sign_of_radical(0, sign(b), sign(a * a - b * b * d)),
              sign_of_radical(sign(a), 0, sign(a * a - b * b * d)), sign_of_radical(sign(a), sign(b), 0)}) {
          if (d > 0) {
            EXPECT_TRUE(guess == 0 || guess == expected);
          }
        }
      }
    }
  }
}

Dyadic dyadic_of(const Rational& x) {
  const Integer d = denominator(x);
  return {Integer(numerator(x)), static_cast<unsigned>(mpz_sizeinbase(d.get_mpz_t(), 2)) - 1};
}

/// The norm's roots in [0, 1), and whether the ball is inside between consecutive roots, by the definition.
struct Course {
  std::shared_ptr<const sturm::Sequence> sequence;
  std::vector<sturm::Root> roots;
  std::vector<int> signs;  ///< before the first root, and after each root

  /// Returns the first change to `sign` after root number `now` (-1: the start).
  [[nodiscard]] JudgedFailure first(int sign, int now) const {
    for (std::size_t i = static_cast<std::size_t>(now + 1); i < roots.size(); ++i) {
      if (signs[i + 1] == sign) return {Kind::later, {sequence, roots[i]}};
    }
    return {};
  }
};

/// Returns nothing if the basis is not proper throughout, or if the norm vanishes.
template <class M>
std::optional<Course> course_of(const M& motion, const ExactPolynomial& norm) {
  sturm::Polynomial p = sturm::from_scaled(norm.scaled());
  sturm::normalize(p);
  if (p.empty()) return std::nullopt;
  Course course;
  course.sequence = std::make_shared<const sturm::Sequence>(p);
  const sturm::Sequence& sequence = *course.sequence;
  course.roots = sturm::roots_on(sequence, 0, 1);
  if (!course.roots.empty() && course.roots.back().is_number() && course.roots.back().upper == 1)
    course.roots.pop_back();
  if (!course.roots.empty() && course.roots.front().is_number() && course.roots.front().lower == 0)
    return std::nullopt;
  Rational before = 0;
  for (std::size_t i = 0; i <= course.roots.size(); ++i) {
    Rational after = 1;
    if (i < course.roots.size()) {
      sturm::Root& root = course.roots[i];
      while (root.lower <= before && !root.is_number()) sturm::halve(sequence, root);
      if (!root.is_number() && i + 1 < course.roots.size()) sturm::halve(sequence, root);
      after = root.lower;
    }
    std::optional<int> sign;
    for (const int part : {1, 3, 5, 7}) {  // the sign is the same throughout the gap
      const auto here = test::judged_inside(motion, dyadic_of(before + (after - before) * part / 8));
      if (!here || *here == 0) return std::nullopt;
      if (sign) {
        EXPECT_EQ(*sign, *here) << "a root is missing";
      }
      sign = here;
    }
    course.signs.push_back(*sign);
    if (i < course.roots.size()) before = course.roots[i].upper;
  }
  return course;
}

/// Checks all failures of the certificate and its negation in turn, by both kernels.
template <class C, class M>
void expect_course(const M& motion, const Course& course, bool inside, int& failures) {
  C certificate = test::certificate_at<C>(motion, Dyadic(0.0), inside);
  test::Functions functions;
  Instant now(0);
  int passed = -1;
  KnownAtStart birth = KnownAtStart::unknown;
  const bool at_once = (course.signs[0] > 0) != inside;
  if (at_once) {
    StageCounts stages;
    EXPECT_EQ((test::first_failure(Kernel::exact, certificate, motion, now, birth, stages).kind),
              Kind::at_birth);
    EXPECT_EQ((test::first_failure(Kernel::filtered, certificate, motion, now, birth, stages).kind),
              Kind::at_birth);
    return;
  }
  for (int event = 0; event < 20; ++event) {
    const ExactPolynomial function = test::exact_function(certificate, motion);
    const JudgedFailure expected = course.first(certificate.inside ? -1 : 1, passed);
    StageCounts stages;
    const Failure filtered = test::first_failure(Kernel::filtered, certificate, motion, now, birth, stages);
    EXPECT_EQ(
        stages.coefficients + stages.isolation + stages.refined + stages.exact + stages.identically_zero, 1U);
    const Failure exact = test::first_failure(Kernel::exact, certificate, motion, now, birth, stages);
    test::expect_confirmed("filtered", filtered, function, expected, test::AtFailure::changes);
    test::expect_confirmed("exact", exact, function, expected, test::AtFailure::changes);
    if (testing::Test::HasFailure() || filtered.kind != Kind::later) return;
    ++failures;
    const bool use_filtered = event % 2 == 0;
    now = Instant(use_filtered ? filtered.time : exact.time, functions, functions.add(function));
    birth = event % 3 == 2 ? KnownAtStart::unknown : KnownAtStart::at_own_root;
    certificate.inside = !certificate.inside;
    EXPECT_EQ((test::sign_just_after(Kernel::filtered, certificate, motion, now, stages)), 1);
    EXPECT_EQ((test::sign_just_after(Kernel::exact, certificate, motion, now, stages)), 1);
    EXPECT_EQ((test::sign_now(Kernel::exact, certificate, motion, now, stages)), 0);
    EXPECT_EQ((test::sign_now(Kernel::filtered, certificate, motion, now, stages)), 0);
    while (passed + 1 < static_cast<int>(course.roots.size())) {
      ++passed;
      if (sturm::compare(*course.sequence, course.roots[static_cast<std::size_t>(passed)], *course.sequence,
                         expected.time.root) == 0)
        break;
    }
  }
}

template <class T>
class RadicalSearch : public testing::Test {
 protected:
  using C = typename T::C;
  using M = typename T::M;

  void expect_right(const M& motion) {
    const C certificate = test::certificate_at<C>(motion, Dyadic(0.0));
    const auto course = course_of(motion, test::exact_function(certificate, motion));
    if (!course) return;
    ++judged_;
    for (const bool inside : {true, false}) expect_course<C>(motion, *course, inside, failures_);
  }

  int judged_ = 0;
  int failures_ = 0;
};

using Cases = testing::Types<BallCase<2, 1, 2>, BallCase<2, 2, 1>, BallCase<2, 3, 1>, BallCase<3, 2, 2>,
                             BallCase<3, 3, 1>, BallCase<3, 4, 1>, BallCase<2, 2, 3>>;
TYPED_TEST_SUITE(RadicalSearch, Cases);

TYPED_TEST(RadicalSearch, FailuresAreWhereTheBallCrossesTheSphere) {
  Random random(751);
  const int rounds = 60;
  for (int i = 0; i < rounds; ++i) {
    SCOPED_TRACE("seed 751, round " + std::to_string(i));
    BallShape shape;
    shape.noise = shape.motion = 0.15;
    shape.whole = i % 5 == 0;
    shape.changing = i % 4 != 0;
    if (i % 6 == 0) shape.largest_radius = 0;
    this->expect_right(test::motion_of<TypeParam>(random, shape));
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_GT(this->judged_, rounds / 2);
  EXPECT_GT(this->failures_, TypeParam::size == 1 ? 1 : rounds / 4);  // few balls fit into a single ball
}

TYPED_TEST(RadicalSearch, GenericMotionIsSettledInDouble) {
  Random random(752);
  StageCounts stages;
  for (int i = 0; i < test::rounds(100); ++i) {
    BallShape shape;
    shape.noise = shape.motion = 0.15;
    shape.reach = 3;
    const auto motion = test::motion_of<TypeParam>(random, shape);
    auto certificate = test::certificate_at<typename TypeParam::C>(motion, Dyadic(0.0));
    const auto inside = test::judged_inside(motion, Dyadic(0.0));
    if (!inside) continue;
    certificate.inside = *inside > 0;
    static_cast<void>(test::first_failure(Kernel::filtered, certificate, motion, Instant(0),
                                          KnownAtStart::unknown, stages));
  }
  EXPECT_LT(stages.exact * 10, stages.coefficients + stages.isolation);
  EXPECT_EQ(stages.identically_zero, 0U);
}

TYPED_TEST(RadicalSearch, ScaleDoesNotMatter) {
  Random random(753);
  for (const int exponent : {-1000, -300, 300, 1000}) {
    BallShape shape;
    shape.noise = shape.motion = 0.15;
    auto motion = test::motion_of<TypeParam>(random, shape);
    const auto certificate =
        test::certificate_at<typename TypeParam::C>(motion, Dyadic(0.0), random() % 2 == 0);
    StageCounts stages;
    const Failure plain =
        test::first_failure(Kernel::exact, certificate, motion, Instant(0), KnownAtStart::unknown, stages);
    auto scaled = motion;
    test::scale(scaled, exponent);
    auto back = scaled;
    test::scale(back, -exponent);
    bool same = true;  // no low bit was lost
    for (BeadId b = 0; b < motion.bead_count(); ++b) {
      for (int k = 0; k <= TypeParam::M::degree; ++k) {
        same &= back.radius(b, k) == motion.radius(b, k);
        for (int axis = 0; axis < TypeParam::dimension; ++axis)
          same &= back.coordinate(b, k, axis) == motion.coordinate(b, k, axis);
      }
    }
    if (!same) continue;
    const Failure exact =
        test::first_failure(Kernel::exact, certificate, scaled, Instant(0), KnownAtStart::unknown, stages);
    StageCounts filtered_stages;
    const Failure filtered = test::first_failure(Kernel::filtered, certificate, scaled, Instant(0),
                                                 KnownAtStart::unknown, filtered_stages);
    EXPECT_EQ(filtered_stages.exact, plain.kind == Kind::at_birth ? 1U : 0U);
    EXPECT_EQ(exact.kind, plain.kind);
    EXPECT_EQ(filtered.kind, plain.kind);
    EXPECT_EQ(exact.time.lower, plain.time.lower);
    EXPECT_EQ(exact.time.upper, plain.time.upper);
  }
}

// Balls at rest or moving on lines: centre and radius at the start, then at the end.
struct Path {
  std::array<double, 3> from;
  double radius_from;
  std::array<double, 3> to;
  double radius_to;
};
template <int Dimension>
BezierMotion<Dimension, 1> moving(const std::vector<Path>& paths) {
  BezierMotion<Dimension, 1> motion(paths.size());
  for (BeadId b = 0; b < paths.size(); ++b) {
    for (int axis = 0; axis < Dimension; ++axis) {
      motion.set_coordinate(b, 0, axis, paths[b].from[static_cast<std::size_t>(axis)]);
      motion.set_coordinate(b, 1, axis, paths[b].to[static_cast<std::size_t>(axis)]);
    }
    motion.set_radius(b, 0, paths[b].radius_from);
    motion.set_radius(b, 1, paths[b].radius_to);
  }
  return motion;
}
Path still(const std::array<double, 3>& at, double radius) { return {at, radius, at, radius}; }

// Returns the kind on which both kernels agree.
template <class C, Motion M>
Failure agreed(const M& motion, bool inside, TouchPolicy touches = TouchPolicy::ignored) {
  const C certificate = test::certificate_at<C>(motion, Dyadic(0.0), inside);
  StageCounts stages;
  const Failure filtered = test::first_failure(Kernel::filtered, certificate, motion, Instant(0),
                                               KnownAtStart::unknown, stages, touches);
  const Failure exact = test::first_failure(Kernel::exact, certificate, motion, Instant(0),
                                            KnownAtStart::unknown, stages, touches);
  EXPECT_EQ(filtered.kind, exact.kind);
  EXPECT_EQ(filtered.time.touch, exact.time.touch);
  return exact;
}

TEST(RadicalSearch, TouchingIsNoFailure) {
  // The line comes so close to a ball's centre that the ball of radius 1/2 just fits inside, at u = 1/2.
  const auto motion = moving<2>({still({0, 0, 0}, 1), {{-1, 0.5, 0}, 0.5, {1, 0.5, 0}, 0.5}});
  using C = BallInSphere<2, 1>;
  EXPECT_EQ(agreed<C>(motion, false).kind, Kind::never);
  EXPECT_EQ(agreed<C>(motion, true).kind, Kind::at_birth);
  const Failure touch = agreed<C>(motion, false, TouchPolicy::reported);
  ASSERT_EQ(touch.kind, Kind::later);
  EXPECT_TRUE(touch.time.touch);
  EXPECT_EQ(touch.time.lower, 0.5);
  const auto through =
      moving<2>({still({0, 0, 0}, 1), {{-1, 0.5, 0}, 0.5, {1, 0.5, 0}, std::nextafter(0.5, 0)}});
  EXPECT_EQ(agreed<C>(through, false).kind, Kind::later);
}

TEST(RadicalSearch, TouchingASphereOfTwo) {
  // The sphere has radius 3 and centre at the origin; a ball of radius 1 moves along the line y = 2.
  const auto motion = moving<2>({still({-2, 0, 0}, 1), still({1, 0, 0}, 2), {{-2, 2, 0}, 1, {2, 2, 0}, 1}});
  const Failure touch = agreed<BallInSphere<2, 2>>(motion, false, TouchPolicy::reported);
  ASSERT_EQ(touch.kind, Kind::later);
  EXPECT_TRUE(touch.time.touch);
  EXPECT_EQ(touch.time.lower, 0.5);
  EXPECT_EQ((agreed<BallInSphere<2, 2>>(motion, false).kind), Kind::never);
}

TEST(RadicalSearch, ZeroForeverNeverFails) {
  const std::vector<Path> basis{still({-2, 0, 0}, 1), still({1, 0, 0}, 2)};
  auto with = [&](const Path& path) {
    auto paths = basis;
    paths.push_back(path);
    return moving<2>(paths);
  };
  using C = BallInSphere<2, 2>;
  for (const bool inside : {true, false}) {
    EXPECT_EQ(agreed<C>(with(still({0, 2, 0}, 1)), inside).kind, Kind::zero);   // touches at rest
    EXPECT_EQ(agreed<C>(with(still({-2, 0, 0}, 1)), inside).kind, Kind::zero);  // a copy of the first
    EXPECT_EQ(agreed<C>(with({{0, 2, 0}, 1, {0, 1, 0}, 2}), inside).kind,
              Kind::zero);  // the ball grows as it moves inwards
  }
  // The whole scene grows.
  EXPECT_EQ(agreed<C>(moving<2>({{{-2, 0, 0}, 1, {-4, 0, 0}, 2},
                                 {{1, 0, 0}, 2, {2, 0, 0}, 4},
                                 {{0, 2, 0}, 1, {0, 4, 0}, 2}}),
                      true)
                .kind,
            Kind::zero);
}

TEST(RadicalSearch, TheOtherRootOfAVanishingNormIsNone) {
  // Equal radii around the origin: rho = 2 or -2. The ball satisfies the norm with rho = -2 and is outside.
  const auto motion = moving<2>({still({-2, 0, 0}, 1), still({2, 0, 0}, 1), still({0, 3, 0}, 2)});
  using C = BallInSphere<2, 2>;
  EXPECT_TRUE(
      (test::exact_function(test::certificate_at<C>(motion, Dyadic(0.0)), motion).scaled().size() > 0));
  EXPECT_EQ(agreed<C>(motion, true).kind, Kind::at_birth);
  EXPECT_EQ(agreed<C>(motion, false).kind, Kind::never);
}

// Two balls approach each other around a ball that is as large as their sphere when it coincides with the
// sphere. At that time A + B sqrt(D) touches zero, and the ball is outside.
TEST(RadicalSearch, ASphereThatShrinksIntoABallLosesIt) {
  const auto motion = moving<3>(
      {{{-2, 0, 0}, 0.25, {-0.5, 0, 0}, 0.25}, {{2, 0, 0}, 0.25, {0.5, 0, 0}, 0.25}, still({0, 0, 0}, 1)});
  const Failure failure = agreed<BallInSphere<3, 2>>(motion, true);
  ASSERT_EQ(failure.kind, Kind::later);
  EXPECT_NEAR(failure.time.lower, 5.0 / 6, 1e-9);
  EXPECT_EQ((agreed<BallInSphere<3, 2>>(motion, false).kind), Kind::at_birth);
}

// If the sphere lies inside the ball, A + B sqrt(D) is positive too.
template <int Dimension, int Size>
void expect_outside(const std::vector<Path>& basis) {
  for (const double radius : {4.0, 40.0}) {
    std::vector<Path> paths(basis.begin(), basis.begin() + Size);
    paths.push_back({{0, 0.25, 0}, radius, {0.25, 0, 0}, radius + 1});
    const auto motion = moving<Dimension>(paths);
    using C = BallInSphere<Dimension, Size>;
    EXPECT_EQ(agreed<C>(motion, true).kind, Kind::at_birth);
    EXPECT_EQ(agreed<C>(motion, false).kind, Kind::never);
    StageCounts stages;
    const C certificate = test::certificate_at<C>(motion, Dyadic(0.0));
    EXPECT_EQ((test::sign_now(Kernel::filtered, certificate, motion, Instant(0.5), stages)), -1);
    EXPECT_EQ((test::sign_now(Kernel::exact, certificate, motion, Instant(0.5), stages)), -1);
    EXPECT_EQ(stages.signs_double, 1U);
  }
}

TEST(RadicalSearch, ABallThatHoldsTheSphereIsNotInside) {
  const std::vector<Path> plane{still({1, 0, 0}, 0.25), still({-0.5, 0.75, 0}, 0.5),
                                still({-0.5, -0.75, 0}, 0.125)};
  expect_outside<2, 1>(plane);
  expect_outside<2, 2>(plane);
  expect_outside<2, 3>(plane);
  const std::vector<Path> space{still({1, 1, 1}, 0.25), still({1, -1, -1}, 0.5), still({-1, 1, -1}, 0.125),
                                still({-1, -1, 1}, 0.375)};
  expect_outside<3, 2>(space);
  expect_outside<3, 3>(space);
  expect_outside<3, 4>(space);
}

// Equal radii: A vanishes, the norm is a square, and the certificate for equal radii gives the same answers.
template <int Dimension, int Size, class Equal>
void expect_as_equal(const Equal& equal, const BezierMotion<Dimension, 1>& motion, bool inside, int& later) {
  using C = BallInSphere<Dimension, Size>;
  const C certificate = test::certificate_at<C>(motion, Dyadic(0.0), inside);
  StageCounts stages;
  const Failure expected =
      test::first_failure(Kernel::exact, equal, motion, Instant(0), KnownAtStart::unknown, stages);
  for (const Failure& failure :
       {test::first_failure(Kernel::exact, certificate, motion, Instant(0), KnownAtStart::unknown, stages),
        test::first_failure(Kernel::filtered, certificate, motion, Instant(0), KnownAtStart::unknown,
                            stages)}) {
    ASSERT_EQ(failure.kind, expected.kind);
    if (failure.kind != Kind::later) continue;
    ++later;
    ExactTime a = exact_time(test::exact_function(certificate, motion), failure.time);
    ExactTime b = exact_time(test::exact_function(equal, motion), expected.time);
    EXPECT_EQ(ExactTime::compare(a, b), 0);
  }
}

TEST(RadicalSearch, AgreesWithTheCertificatesOfEqualRadii) {
  Random random(755);
  int later = 0;
  for (int i = 0; i < test::rounds(60); ++i) {
    SCOPED_TRACE("seed 755, round " + std::to_string(i));
    BallShape shape;
    shape.noise = shape.motion = 0.15;
    shape.largest_radius = 0;
    shape.whole = i % 2 == 0;
    const bool inside = random() % 2 == 0;
    const auto alike = [&](auto motion) {
      for (BeadId b = 0; b < motion.bead_count(); ++b) {
        for (int k = 0; k <= 1; ++k) motion.set_radius(b, k, 0.3 * (1 + k));
        for (int k = 0; k <= 1; ++k) motion.set_weight(b, k, 0);
      }
      return motion;
    };
    const auto two = alike(test::motion_of<BallCase<3, 2, 1>>(random, shape));
    expect_as_equal<3, 2>(BeadInSphere<2>{{0, 1, 2}, inside}, two, inside, later);
    const auto three = alike(test::motion_of<BallCase<3, 3, 1>>(random, shape));
    expect_as_equal<3, 3>(BeadInSphere<3>{{0, 1, 2, 3}, inside}, three, inside, later);
    const auto plane = alike(test::motion_of<BallCase<2, 3, 1>>(random, shape));
    const int turn = test::certificate_at<BallInSphere<2, 3>>(plane, Dyadic(0.0)).orientation;
    expect_as_equal<2, 3>(PowerTest<2>({0, 1, 2, 3}, inside ? -turn : turn), plane, inside, later);
    const auto four = alike(test::motion_of<BallCase<3, 4, 1>>(random, shape));
    const int side = test::certificate_at<BallInSphere<3, 4>>(four, Dyadic(0.0)).orientation;
    expect_as_equal<3, 4>(PowerTest<3>({0, 1, 2, 3, 4}, inside ? -side : side), four, inside, later);
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_GT(later, test::rounds(60));
}

template <class T>
void expect_judged(const typename T::M& motion) {
  const auto certificate = test::certificate_at<typename T::C>(motion, Dyadic(0.0));
  const auto course = course_of(motion, test::exact_function(certificate, motion));
  ASSERT_TRUE(course);
  int failures = 0;
  for (const bool inside : {true, false}) expect_course<typename T::C>(motion, *course, inside, failures);
  EXPECT_GT(failures, 0);
}

// a = 0 at u = 1/2 and a > 0 on one side: the radii decrease along the basis as fast as the centres separate.
TEST(RadicalSearch, PassesTheVanishingOfTheLeadingCoefficient) {
  for (const double change : {0.125, -0.125, 0.0}) {
    const Path first = still({0, 0, 0}, 5);
    const Path second{{5, 0, 0}, 2 + change, {5, 0, 0}, 2 - change};
    const Path third = still({0, 5, 0}, 1);
    const Path fourth = still({0, 0, 0.25}, 5);
    const Path ball{{1, 0.2, 0.1}, 1, {1, 8, 0.1}, 1};
    expect_judged<BallCase<2, 3, 1>>(moving<2>({first, second, third, ball}));
    expect_judged<BallCase<3, 3, 1>>(moving<3>({first, second, third, ball}));
    expect_judged<BallCase<3, 4, 1>>(moving<3>({first, second, third, fourth, ball}));
  }
}

TEST(RadicalSearch, RadiiOfUnlikeSize) {
  const Path giant = still({0, 0, 0}, 1e9);
  const Path bump = still({1e9 - 0.5, 0, 0}, 1);
  const Path ball{{0, 1e9 - 2, 0}, 1e-3, {0, 1e9 + 2, 0}, 1};
  expect_judged<BallCase<2, 1, 1>>(moving<2>({giant, ball}));
  expect_judged<BallCase<2, 2, 1>>(moving<2>({giant, bump, ball}));
  expect_judged<BallCase<3, 2, 1>>(moving<3>({bump, giant, ball}));
}

TEST(RadicalSearch, NearlyFlatBases) {
  const double thin = 0x1p-30;
  const Path ball{{0, 0.1, 0}, 0.25, {0, 3, 0.5}, 0.25};
  expect_judged<BallCase<3, 3, 1>>(
      moving<3>({still({-1, 0, 0}, 0.5), still({1, 0, 0}, 0.5), still({0, 1 + thin, 0}, 0.5), ball}));
  expect_judged<BallCase<2, 3, 1>>(
      moving<2>({still({-1, 0, 0}, 0.5), still({1, 0, 0}, 0.5), still({0, 1 + thin, 0}, 0.5), ball}));
}

// Balls that touch from inside, or coincide, are not a proper basis. Both kernels must give the same answer.
TEST(RadicalSearch, ImproperBasesDoNoHarm) {
  const Path ball{{0, 0.5, 0}, 0.5, {1, 4, 1}, 0.5};
  const std::vector<std::vector<Path>> bases{
      {still({0, 0, 0}, 2), still({1, 0, 0}, 1), still({0, 1, 0}, 1), still({0, 0, 1}, 1)},
      {still({0, 0, 0}, 1), still({0, 0, 0}, 1), still({0, 0, 0}, 1), still({0, 0, 0}, 1)},
      {still({0, 0, 0}, 1), still({1, 0, 0}, 1), still({2, 0, 0}, 1), still({3, 0, 0}, 1)}};
  for (auto paths : bases) {
    paths.push_back(ball);
    for (const bool inside : {true, false}) {
      static_cast<void>(agreed<BallInSphere<3, 4>>(moving<3>(paths), inside));
      static_cast<void>(agreed<BallInSphere<3, 3>>(moving<3>({paths[0], paths[1], paths[2], ball}), inside));
      static_cast<void>(agreed<BallInSphere<2, 3>>(moving<2>({paths[0], paths[1], paths[2], ball}), inside));
      static_cast<void>(agreed<BallInSphere<3, 2>>(moving<3>({paths[0], paths[1], ball}), inside));
    }
  }
}

// The function changes sign when the orientation of the basis flips, and changes back when the norm vanishes:
// this is not a touch.
TEST(RadicalSearch, ABasisThatTurnedOverTouchesNothing) {
  const auto motion = moving<2>({{{3, 0, 0}, 2, {-3, -3, 0}, 2},
                                 {{2, 3, 0}, 2, {2, 2, 0}, 2},
                                 {{-1, -1, 0}, 3, {2, 0, 0}, 3},
                                 {{3, -3, 0}, 2, {1, 2, 0}, 2}});
  EXPECT_EQ((agreed<BallInSphere<2, 3>>(motion, false, TouchPolicy::reported).kind), Kind::never);
}

}  // namespace
}  // namespace kds::radical_search_test
