#include "certificates/types/segments.h"

#include <gtest/gtest.h>

#include "tests/support/inputs/random_motion.h"
#include "tests/support/judges/rational_geometry.h"
#include "tests/support/searches.h"

namespace kds::segments_test {
namespace {

using test::RationalPoint;

RationalPoint plus(RationalPoint a, const RationalPoint& b) {
  for (std::size_t axis = 0; axis < a.size(); ++axis) a[axis] += b[axis];
  return a;
}
RationalPoint cross(const RationalPoint& a, const RationalPoint& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Compares the signs with those of rational numbers, with the shift of beads 4 and 5 and without one.
template <Motion M>
void expect_signs(unsigned seed) {
  test::Random random(seed);
  for (int i = 0; i < 20; ++i) {
    for (const test::MotionKind kind : test::all_motion_kinds) {
      const auto motion = test::random_motion<M>(random, 6, kind);
      const Dyadic time = test::random_dyadic(random);
      std::array<RationalPoint, 6> at;
      for (BeadId b = 0; b < 6; ++b) at[b] = test::point_at(motion, b, time);
      for (const bool is_shifted : {false, true}) {
        const BeadId from = is_shifted ? 5 : 4;
        const RationalPoint shift = test::minus(at[4], at[from]);
        const RationalPoint c = plus(at[2], shift), d = plus(at[3], shift);
        const RationalPoint ab = test::minus(at[1], at[0]);
        const int volume = test::sign(test::dot(cross(ab, test::minus(c, at[0])), test::minus(d, at[0])));
        EXPECT_EQ(test::sign_at(SegmentsOrientation{{0, 1, 2, 3, 4, from}}, motion, time), volume);
        EXPECT_EQ(test::sign_at(SegmentsOrientation{{0, 1, 2, 3, 4, from}, -1}, motion, time), -volume);
        EXPECT_EQ(test::sign_at(SegmentsOrientation{{0, 1, 3, 2, 4, from}}, motion, time), -volume);
        EXPECT_EQ(test::sign_at(SegmentsOrientation{{2, 3, 0, 1, from, 4}}, motion, time), volume);
        const RationalPoint product = cross(ab, test::minus(d, at[2]));
        EXPECT_EQ(test::sign_at(CrossComponent<0>{{0, 1, 2, 3, 4, from}}, motion, time),
                  test::sign(product[0]));
        EXPECT_EQ(test::sign_at(CrossComponent<1>{{0, 1, 2, 3, 4, from}}, motion, time),
                  test::sign(product[1]));
        EXPECT_EQ(test::sign_at(CrossComponent<2>{{0, 1, 2, 3, 4, from}}, motion, time),
                  test::sign(product[2]));
        EXPECT_EQ(test::sign_at(BeyondEnds{{2, 3, 0, 4, from}}, motion, time),
                  test::sign(test::dot(test::minus(c, at[0]), test::minus(d, at[0]))));
      }
    }
  }
}

TEST(Segments, HaveTheSignsOfRationalNumbers) {
  expect_signs<BezierMotion<3, 1>>(61);
  expect_signs<BezierMotion<3, 3>>(62);
}

TEST(Segments, AreCoplanarWhereTheyMeetOrAreParallel) {
  const auto volume = [](const std::vector<std::array<double, 3>>& points) {
    return test::sign_at(SegmentsOrientation{{0, 1, 2, 3, 0, 0}}, test::at_rest(points), Dyadic(0.0));
  };
  EXPECT_EQ(volume({{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}}), 0);
  EXPECT_EQ(volume({{0, 0, 0}, {1, 0, 0}, {0, 1, 1}, {3, 1, 1}}), 0);
  EXPECT_EQ(volume({{0, 0, 0}, {0, 0, 0}, {0, 1, 1}, {3, 1, 2}}), 0);  // a segment of length zero
  EXPECT_EQ(volume({{-1, 0, 0}, {1, 0, 0}, {0, -1, 0x1p-1074}, {0, 1, 0x1p-1074}}), -1);
}

TEST(Segments, TellImagesApartAndNameNoShifts) {
  const SegmentsOrientation image{{0, 1, 2, 3, 8, 9}}, other{{0, 1, 2, 3, 6, 7}}, none{{0, 1, 2, 3, 8, 8}};
  EXPECT_NE(image.identity(), other.identity());
  EXPECT_NE(image.identity(), none.identity());
  EXPECT_EQ(image.identity().beads[4], no_bead);
  EXPECT_EQ(none.identity(), (SegmentsOrientation{{0, 1, 2, 3, 0, 0}}.identity()));
}

}  // namespace
}  // namespace kds::segments_test
