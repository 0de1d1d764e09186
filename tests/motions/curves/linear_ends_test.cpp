#include "motions/curves/bezier_motion.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <vector>

#include "tests/support/inputs/random_motion.h"

namespace kds::linear_ends_test {
namespace {

using test::Random;
using test::uniform;

struct Frames {
  std::vector<double> start, end, radii;
};
Frames random_frames(Random& random, std::size_t beads) {
  Frames frames{std::vector<double>(3 * beads), std::vector<double>(3 * beads), std::vector<double>(beads)};
  for (double& x : frames.start) x = uniform(random, -9, 9);
  for (double& x : frames.end) x = uniform(random, -9, 9);
  for (double& r : frames.radii) r = uniform(random, 0, 2);
  return frames;
}

template <int D>
void set(BezierMotion<D, 1>& motion, const Frames& frames) {
  motion.set_ends(frames.start.data(), frames.end.data(), frames.radii.data());
}

template <class D>
class LinearEnds : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 1>, std::integral_constant<int, 2>,
                                  std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(LinearEnds, Dimensions);

TYPED_TEST(LinearEnds, AreTheFramesNumberByNumber) {
  constexpr int d = TypeParam::value;
  Random random(1);
  for (const std::size_t beads : {0, 1, 2, 3, 4, 5, 30}) {
    const Frames frames = random_frames(random, beads);
    BezierMotion<d, 1> motion(beads);
    set(motion, frames);
    for (BeadId b = 0; b < beads; ++b) {
      const double radius = frames.radii[b];
      for (int k = 0; k <= 1; ++k) {
        const std::vector<double>& frame = k == 0 ? frames.start : frames.end;
        for (int axis = 0; axis < d; ++axis)
          EXPECT_EQ(motion.coordinate(b, k, axis), frame[3 * b + static_cast<std::size_t>(axis)]);
        EXPECT_EQ(motion.weight(b, k), radius * radius);
        EXPECT_EQ(motion.radius(b, k), radius);
      }
    }
  }
}

TYPED_TEST(LinearEnds, AreFiniteWhateverBeadIsNot) {
  constexpr int d = TypeParam::value;
  Random random(2);
  for (const std::size_t beads : {1, 2, 6}) {
    BezierMotion<d, 1> motion(beads);
    for (const double bad :
         {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
          std::numeric_limits<double>::quiet_NaN()}) {
      for (std::size_t b = 0; b < beads; ++b) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
          for (const bool at_end : {false, true}) {
            Frames frames = random_frames(random, beads);
            (at_end ? frames.end : frames.start)[3 * b + axis] = bad;
            if (axis < d) {
              EXPECT_THROW(set(motion, frames), std::invalid_argument) << b;
            } else {
              EXPECT_NO_THROW(set(motion, frames));  // not a coordinate of any bead
            }
          }
        }
        Frames frames = random_frames(random, beads);
        frames.radii[b] = bad;
        EXPECT_THROW(set(motion, frames), std::invalid_argument) << b;
        frames.radii[b] = 0x1p600;  // the weight, which is the squared radius, overflows
        EXPECT_THROW(set(motion, frames), std::invalid_argument) << b;
      }
    }
  }
}

}  // namespace
}  // namespace kds::linear_ends_test
