#include "structures/necklace/balls.h"

#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "motions/curves/bezier_motion.h"
#include "tests/support/inputs/random_motion.h"

namespace kds::balls_test {
namespace {

using namespace test;

template <int D, Motion M>
void expect_at(const Balls<D>& balls, const M& motion, int k) {
  ASSERT_EQ(balls.size(), motion.bead_count());
  bool equal = true;
  for (BeadId b = 0; b < balls.size(); ++b) {
    for (std::size_t axis = 0; axis < D; ++axis) {
      const double x = motion.coordinate(b, k, static_cast<int>(axis));
      EXPECT_EQ(balls.coordinates(axis)[b], x);
      EXPECT_EQ(balls.rows()[b].center[axis], x);
    }
    EXPECT_EQ(balls.radii()[b], motion.radius(b, k));
    EXPECT_EQ(balls.rows()[b].radius, motion.radius(b, k));
    equal = equal && motion.radius(b, k) == motion.radius(0, k);
  }
  EXPECT_EQ(balls.equal_radii(), equal);
}

template <Motion M>
void set_radii(M& motion, Random& random, bool equal) {
  for (BeadId b = 0; b < motion.bead_count(); ++b) {
    const double radius = equal ? 0.5 : uniform(random, 0, 2);
    for (int k = 0; k <= degree_of(motion); ++k) motion.set_radius(b, k, radius);
  }
}

// Reuses the same memory for one motion after another: more beads, fewer beads, other radii, the same radii.
template <Motion M>
void expect_to_follow(Random& random) {
  constexpr int d = M::dimension;
  Balls<d> balls;
  const Balls<d> balls_of_fewer;
  for (const std::size_t beads : {5, 1, 8, 8, 8, 3, 13}) {
    for (const bool equal : {true, true, false, false, true}) {
      M motion = random_motion<M>(random, beads, MotionKind::generic);
      set_radii(motion, random, equal);
      for (int k = 0; k <= degree_of(motion); ++k) {
        balls.move_to(Curves<d>(motion), k);
        expect_at(balls, motion, k);
        BallRows<d> rows(Curves<d>(motion), k);
        EXPECT_EQ(rows.size(), beads);
        EXPECT_EQ(rows.equal_radii(), balls.equal_radii());
      }
      const Balls<d> start(Curves<d>(motion), 0);
      EXPECT_FALSE(balls.move_on_from(balls_of_fewer, Curves<d>(motion)));
      expect_at(balls, motion, 1);
      EXPECT_TRUE(balls.move_on_from(start, Curves<d>(motion)));
      expect_at(balls, motion, 1);
    }
  }
}

TEST(Balls, FollowAMotion) {
  Random random(1);
  expect_to_follow<BezierMotion<2, 1>>(random);
  expect_to_follow<BezierMotion<3, 1>>(random);
  expect_to_follow<BezierMotion<2, 3>>(random);
  expect_to_follow<BezierMotion<3, 3>>(random);
}

void expect_to_know_the_start(Random& random, bool equal) {
  auto motion = random_motion<BezierMotion<3, 1>>(random, 6, MotionKind::generic);
  set_radii(motion, random, equal);
  const Curves<3> curves(motion);
  Balls<3> next;
  EXPECT_FALSE(next.move_on_from(Balls<3>(curves, 1), curves));
  const Balls<3> start(curves, 0);
  for (BeadId b = 0; b < 6; ++b) {
    for (int axis = 0; axis < 3; ++axis) {
      const double x = motion.coordinate(b, 0, axis);
      motion.set_coordinate(b, 0, axis, std::nextafter(x, 10));
      EXPECT_FALSE(next.move_on_from(start, curves)) << b;
      motion.set_coordinate(b, 0, axis, x);
      EXPECT_TRUE(next.move_on_from(start, curves)) << b;
    }
    const double radius = motion.radius(b, 0), weight = motion.weight(b, 0);
    motion.set_radius(b, 0, radius + 1);
    EXPECT_FALSE(next.move_on_from(start, curves)) << b;
    motion.set_radius(b, 0, radius);
    motion.set_weight(b, 0, weight + 1);  // balls do not depend on weights
    EXPECT_TRUE(next.move_on_from(start, curves)) << b;
  }
  const auto fewer = random_motion<BezierMotion<3, 1>>(random, 5, MotionKind::generic);
  EXPECT_FALSE(next.move_on_from(start, Curves<3>(fewer)));
}

TEST(Balls, KnowTheStartOfAMotionBitForBit) {
  Random random(2);
  expect_to_know_the_start(random, false);
  expect_to_know_the_start(random, true);
}

// A motion with raw memory, which can contain values that the motion classes refuse.
template <int D>
struct RawMotion {
  static constexpr int dimension = D, degree = 1;
  std::vector<std::array<double, 2 * (D + 1)>> points;
  std::vector<std::array<double, 2>> own_radii;
  explicit RawMotion(std::size_t beads) : points(beads), own_radii(beads) {}
  std::size_t bead_count() const { return points.size(); }
  double coordinate(BeadId b, int k, int axis) const { return control_point(b, k)[axis]; }
  double weight(BeadId b, int k) const { return control_point(b, k)[D]; }
  const double* control_point(BeadId b, int k) const { return points[b].data() + (D + 1) * k; }
  double radius(BeadId b, int k) const { return own_radii[b][static_cast<std::size_t>(k)]; }
  const double* radii(BeadId b) const { return own_radii[b].data(); }
};

template <int D>
void expect_refusal(const RawMotion<D>& motion, const std::string& message) {
  const RawMotion<D> before(motion.bead_count());  // all radii are zero, like most radii of `motion`
  for (const bool moved : {false, true}) {
    Balls<D> balls;
    if (moved) balls.move_to(Curves<D>(before), 1);
    for (int again = 0; again < 2; ++again) {
      EXPECT_THAT([&] { balls.move_to(Curves<D>(motion), 1); },
                  testing::ThrowsMessage<InputError>(testing::HasSubstr(message)));
    }
  }
}

template <int D>
void expect_refusals() {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (BeadId b = 0; b < 6; ++b) {
    const std::string name = "bead " + std::to_string(b) + ": ";
    for (const double bad : {infinity, -infinity, std::numeric_limits<double>::quiet_NaN()}) {
      for (std::size_t axis = 0; axis < D; ++axis) {
        RawMotion<D> motion(6);
        motion.points[b][D + 1 + axis] = bad;
        expect_refusal(motion, name + "expected finite coordinates");
      }
      RawMotion<D> motion(6);
      motion.own_radii[b][1] = bad;
      expect_refusal(motion, name + "expected a finite radius, not negative");
      motion.own_radii[b][1] = 0;
      motion.points[b][2 * D + 1] = bad;  // a weight, which balls do not read
      EXPECT_NO_THROW(Balls<D>(Curves<D>(motion), 1));
    }
    RawMotion<D> motion(6);
    motion.own_radii[b][1] = -0x1p-1074;
    expect_refusal(motion, name + "expected a finite radius, not negative");
  }
}

TEST(Balls, NameTheBeadThatIsNone) {
  expect_refusals<2>();
  expect_refusals<3>();
}

}  // namespace
}  // namespace kds::balls_test
