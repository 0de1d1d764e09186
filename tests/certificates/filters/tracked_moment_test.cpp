// Compares signs during a short period with exact signs at times in the period.

#include "certificates/filters/tracked_moment.h"

#include <gtest/gtest.h>

#include "certificates/exact/exact_time.h"
#include "certificates/formulas/function_values.h"
#include "certificates/types/ball_in_sphere.h"
#include "tests/support/inputs/random_motion.h"

namespace kds::tracked_moment_test {
namespace {

using namespace test;

struct Tally {
  int certain = 0, doubtful = 0;
};

/// Judges one polynomial of a certificate, in periods of any length, including zero.
template <class Polynomial, class M>
void judge(const M& motion, Random& random, Tally& tally) {
  Polynomial polynomial;
  for (std::size_t i = 0; i < polynomial.beads.size(); ++i) polynomial.beads[i] = static_cast<BeadId>(i);
  using C = Curves<M::dimension>;
  const ExactPolynomial exact = FunctionValues<Polynomial, C>::exact(polynomial, C(motion));
  const double lower = uniform(random, 0, 1);
  const double length = std::ldexp(1.0, -static_cast<int>(random() % 60));
  const double upper = random() % 3 == 0 ? lower : std::min(1.0, lower + length);
  const TrackedMoment<M> view(motion, polynomial.beads, lower, upper, channels_of<Polynomial>);
  const int sign = certain_sign(Polynomial::formula(view, polynomial.beads).scaled[0]);
  EXPECT_EQ((FunctionValues<Polynomial, C>::sign_during(polynomial, C(motion), lower, upper)), sign);
  if (sign == 0) {
    ++tally.doubtful;
    return;
  }
  ++tally.certain;
  for (const double share : {0.0, 0.25, 0.5, 1.0}) {
    ExactTime time{Dyadic(std::clamp(lower + share * (upper - lower), lower, upper))};
    EXPECT_EQ(sign_at(exact, time), sign) << lower << " to " << upper;
  }
}

/// The number of certain signs does not depend on the scale.
TEST(TrackedMoment, ScalesWithTheInput) {
  using Radical = BallInSphere<3, 4>::Radical;
  const auto tally_at = [](int exponent) {
    Tally tally;
    for (unsigned seed = 0; seed < 30; ++seed) {
      Random random(seed);
      auto motion = random_motion<BezierMotion<3, 1>>(random, 6, MotionKind::generic);
      scale(motion, exponent);
      judge<Radical::Rational>(motion, random, tally);
      judge<Radical::Norm>(motion, random, tally);
    }
    return tally;
  };
  const Tally tally = tally_at(0);
  EXPECT_GT(tally.certain, 30);
  for (const int exponent : {-900, -300, 300, 900})
    EXPECT_EQ(tally_at(exponent).certain, tally.certain) << exponent;
}

template <class Radical, class M>
void judge_radical(Tally& tally) {
  for (unsigned seed = 0; seed < 60U; ++seed) {
    for (const MotionKind kind : all_motion_kinds) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << ", kind " << static_cast<int>(kind));
      Random random(1000 * seed + static_cast<unsigned>(kind));
      const auto motion = random_motion<M>(random, 6, kind);
      judge<typename Radical::Rational>(motion, random, tally);
      judge<typename Radical::Root>(motion, random, tally);
      judge<typename Radical::Norm>(motion, random, tally);
      if (testing::Test::HasFailure()) return;
    }
  }
}

TEST(TrackedMoment, SignsHoldAllTheTime) {
  Tally tally;
  judge_radical<BallInSphere<3, 3>::Radical, BezierMotion<3, 1>>(tally);
  judge_radical<BallInSphere<3, 4>::Radical, BezierMotion<3, 1>>(tally);
  judge_radical<BallInSphere<2, 3>::Radical, BezierMotion<2, 1>>(tally);
  judge_radical<BallInSphere<2, 2>::RadiusCondition, BezierMotion<2, 3>>(tally);
  EXPECT_GT(tally.certain, 1000);
  EXPECT_GT(tally.doubtful, 100);
}

}  // namespace
}  // namespace kds::tracked_moment_test
