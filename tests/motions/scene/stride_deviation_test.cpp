#include "motions/scene/stride_deviation.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <span>
#include <string>

#include "motions/base/input_error.h"
#include "motions/curves/positions.h"

namespace kds::stride_deviation_test {
namespace {

/// Makes a source of these frames.
MemoryFrames source_of(std::vector<Eigen::Matrix3Xd> frames) {
  Trajectory trajectory;
  trajectory.frames = std::move(frames);
  return MemoryFrames(std::span(&trajectory, 1));
}

/// Makes beads that wander in space or in the plane y = 0.25.
std::vector<Eigen::Matrix3Xd> wandering(unsigned seed, std::size_t frames, bool planar) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> step(-0.5, 0.5);
  std::vector<Eigen::Matrix3Xd> all;
  Eigen::Matrix3Xd now = Eigen::Matrix3Xd::NullaryExpr(3, 5, [&] { return 8 * step(random); });
  if (planar) now.row(1).setConstant(0.25);
  for (std::size_t k = 0; k < frames; ++k) {
    all.push_back(now);
    now += Eigen::Matrix3Xd::NullaryExpr(3, 5, [&] { return step(random); });
    if (planar) now.row(1).setConstant(0.25);
  }
  return all;
}

Scene every_so_many(const std::vector<Eigen::Matrix3Xd>& frames, std::size_t stride, FrameMotion motion) {
  Trajectory some;
  some.file = "some";
  for (std::size_t k = 0; k < frames.size(); k += stride) {
    some.frames.push_back(frames[k]);
    some.frame_numbers.push_back(k);
  }
  return Scene(std::span(&some, 1), std::vector<double>(5, 1.0), motion);
}

Rational square(const std::array<Rational, 3>& v) { return v[0] * v[0] + v[1] * v[1] + v[2] * v[2]; }

/// Returns the exact square of a bead's deviation in a part of a step, at `time` of the step, which is
/// `share` of the part.
template <class M>
Rational deviation_at(const Scene& scene, const M& motion, BeadId bead, const Dyadic& time,
                      const Rational& share, const Eigen::Matrix3Xd& before, const Eigen::Matrix3Xd& after) {
  const auto position = exact_position(motion, bead, time);
  std::array<Rational, 3> apart;
  const bool planar = scene.dimension() == 2;  // x and z
  const std::array<Rational, 3> there =
      planar ? std::array<Rational, 3>{position[0], Rational(0.25), position[1]}
             : std::array<Rational, 3>{position[0], position[1], position[2]};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto row = static_cast<Eigen::Index>(axis), column = static_cast<Eigen::Index>(bead);
    apart[axis] =
        there[axis] - ((1 - share) * Rational(before(row, column)) + share * Rational(after(row, column)));
  }
  return square(apart);
}

/// Checks that no deviation at an exact time exceeds the result, and that, at frames, some deviation reaches
/// it.
template <class M>
void expect_bounds(bool planar, FrameMotion kind) {
  constexpr std::size_t stride = 4;
  for (unsigned seed = 0; seed < 6; ++seed) {
    SCOPED_TRACE(seed);
    const auto frames = wandering(seed, 3 * stride + 1, planar);
    const Scene scene = every_so_many(frames, stride, kind);
    ASSERT_EQ(scene.dimension(), planar ? 2 : 3);
    MemoryFrames every = source_of(frames);
    const StrideDeviation found = deviation_of_stride(scene, every, stride);
    EXPECT_EQ(found.skipped, 3 * (stride - 1));
    std::vector<Rational> largest(5, 0);
    M motion(5);
    for (std::size_t step = 0; step < scene.step_count(); ++step) {
      scene.load(step, motion);
      for (std::size_t i = 0; i < 64; ++i) {  // the parts of the step are quarters
        const std::size_t part = i / 16, place = step * stride + part;
        for (BeadId b = 0; b < 5; ++b) {
          const Rational at = deviation_at(scene, motion, b, Dyadic(static_cast<double>(i) / 64),
                                           fraction(i % 16, 16), frames[place], frames[place + 1]);
          ASSERT_LE(at, Rational(found.of_bead[b]) * Rational(found.of_bead[b]));
          largest[b] = std::max(largest[b], at);
        }
      }
    }
    for (BeadId b = 0; b < 5; ++b) {
      EXPECT_LE(found.of_bead[b], found.largest);
      const double reached = std::sqrt(largest[b].get_d());
      EXPECT_GT(reached, found.of_bead[b] * (M::degree == 1 ? 1 - 1e-11 : 0.8));
    }
    EXPECT_EQ(found.of_bead[found.bead], found.largest);
    if (M::degree == 1) {  // the deviation is reached
      const std::size_t step = found.frame / stride;
      scene.load(step, motion);
      const double u = static_cast<double>(found.frame % stride) / stride;
      EXPECT_NE(u, 0);
      const Rational there =
          deviation_at(scene, motion, found.bead, Dyadic(u), 0, frames[found.frame], frames[found.frame]);
      EXPECT_NEAR(std::sqrt(there.get_d()), found.largest, 1e-11);
    }
  }
}

TEST(StrideDeviation, BoundsTheDeviationAtAllTimes) {
  expect_bounds<BezierMotion<3, 1>>(false, FrameMotion::linear);
  expect_bounds<BezierMotion<3, 3>>(false, FrameMotion::hermite);
  expect_bounds<BezierMotion<2, 1>>(true, FrameMotion::linear);
  expect_bounds<BezierMotion<2, 3>>(true, FrameMotion::hermite);
}

TEST(StrideDeviation, IsNothingWhereTheMotionIsTheSame) {
  std::vector<Eigen::Matrix3Xd> frames;
  for (int k = 0; k <= 4; ++k) frames.push_back(Eigen::Matrix3Xd::Constant(3, 5, 0.25 * k));
  const Scene scene = every_so_many(frames, 2, FrameMotion::linear);
  MemoryFrames every = source_of(frames);
  EXPECT_LT(deviation_of_stride(scene, every, 2).largest, 1e-11);
}

TEST(StrideDeviation, IsInfiniteWhereDoublesOverflow) {
  std::vector<Eigen::Matrix3Xd> frames;
  for (int k = 0; k <= 4; ++k)
    frames.push_back(Eigen::Matrix3Xd::Constant(3, 5, k % 2 == 0 ? 1e308 : -1e308));
  for (std::size_t k = 0; k < frames.size(); ++k) frames[k].col(1).setConstant(static_cast<double>(k));
  const Scene scene = every_so_many(frames, 4, FrameMotion::linear);
  MemoryFrames every = source_of(frames);
  const StrideDeviation found = deviation_of_stride(scene, every, 4);
  EXPECT_EQ(found.of_bead[0], std::numeric_limits<double>::infinity());
  EXPECT_LT(found.of_bead[1], 1e-11);
}

TEST(StrideDeviation, RefusesOtherFrames) {
  const auto frames = wandering(1, 9, false);
  const Scene scene = every_so_many(frames, 4, FrameMotion::linear);
  MemoryFrames few = source_of({frames.begin(), frames.begin() + 6});
  EXPECT_THROW((void)deviation_of_stride(scene, few, 4), InputError);
  MemoryFrames every = source_of(frames);
  EXPECT_THROW((void)deviation_of_stride(scene, every, 3), InputError);
}

}  // namespace
}  // namespace kds::stride_deviation_test
