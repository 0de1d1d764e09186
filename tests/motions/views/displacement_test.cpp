#include "motions/views/displacement.h"

#include <gtest/gtest.h>

#include "motions/curves/positions.h"
#include "tests/support/inputs/random_motion.h"

namespace kds::displacement_test {
namespace {

using test::Random;

template <Motion M>
Rational coordinate(const M& motion, BeadId b, int axis, const Dyadic& time) {
  return exact_position(motion, b, time)[static_cast<std::size_t>(axis)];
}

TEST(Displacements, BoundsEveryDifferenceOfTwoBeads) {
  Random random(5);
  using M = BezierMotion<3, 2>;
  for (const auto kind : test::all_motion_kinds) {
    M first = test::random_motion<M>(random, 6, kind);
    M later = test::random_motion<M>(random, 6, kind);
    for (M* motion : {&first, &later}) {
      for (BeadId b = 0; b < 6; ++b) {
        for (int k = 0; k <= 2; ++k) {
          motion->set_weight(b, k, 1);
          motion->set_radius(b, k, 1);
        }
      }
    }
    Displacements<3> wandering;
    wandering.set_reference(Curves<3>(first));
    wandering.look_at(Curves<3>(later));
    for (const double u : {0.0, 0.25, 0.8125, 1.0}) {
      for (BeadId i = 0; i < 6; ++i) {
        for (BeadId j = 0; j < i; ++j) {
          const Rational most = Rational(wandering.strays()[i]) + Rational(wandering.strays()[j]);
          for (int axis = 0; axis < 3; ++axis) {
            const Rational then =
                coordinate(later, i, axis, Dyadic(u)) - coordinate(later, j, axis, Dyadic(u));
            const Rational before =
                Rational(first.coordinate(i, 0, axis)) - Rational(first.coordinate(j, 0, axis));
            EXPECT_LE(abs(then - before), most);
          }
        }
      }
    }
  }
}

TEST(Displacements, DriftIsFree) {
  BezierMotion<2, 1> motion(3);
  for (BeadId b = 0; b < 3; ++b) {
    for (int k = 0; k <= 1; ++k) {
      motion.set_coordinate(b, k, 0, b + 1000.0 * k);
      motion.set_coordinate(b, k, 1, b * b - 7.0 * k);
    }
  }
  Displacements<2> wandering;
  EXPECT_FALSE(wandering.has_reference());
  wandering.set_reference(Curves<2>(motion));
  wandering.look_at(Curves<2>(motion));
  for (const double stray : wandering.strays()) EXPECT_LT(stray, 1e-11);
  motion.set_coordinate(1, 1, 0, 1001.5);  // half a unit farther than the others
  wandering.look_at(Curves<2>(motion));
  EXPECT_GT(wandering.strays()[1], 0.3);
  EXPECT_LT(wandering.strays()[1], 0.5);
}

TEST(Displacements, ChangedWeightsAndRadiiAreNeverTolerated) {
  BezierMotion<1, 1> motion(2);
  Displacements<1> wandering;
  wandering.set_reference(Curves<1>(motion));
  motion.set_weight(0, 1, 0.5);
  motion.set_radius(1, 0, 0.5);
  wandering.look_at(Curves<1>(motion));
  EXPECT_TRUE(std::isinf(wandering.strays()[0]));
  EXPECT_TRUE(std::isinf(wandering.strays()[1]));
}

}  // namespace
}  // namespace kds::displacement_test
