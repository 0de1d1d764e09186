#include "motions/scene/straightened_frames.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <random>
#include <span>

#include "motions/numbers/exact_number.h"

namespace kds::straightened_frames_test {
namespace {

using Frames = std::vector<Eigen::Matrix3Xd>;

Frames straightened(const Frames& frames, double tolerance, int passes = 1) {
  Trajectory samples;
  samples.frames = frames;
  StraightenedFrames straight(std::make_unique<MemoryFrames>(std::span(&samples, 1)), tolerance);
  Frames all;
  for (int pass = 0; pass < passes; ++pass) {
    all.clear();
    straight.seek(0);
    for (FrameRead frame; straight.next(frame);) {
      EXPECT_EQ(frame.stamp.number, all.size());
      all.push_back(frame.positions);
    }
  }
  return all;
}

Rational square_of_deviation(const Frames& a, const Frames& b, std::size_t frame, Eigen::Index bead) {
  Rational square = 0;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const Rational apart = Rational(a[frame](axis, bead)) - Rational(b[frame](axis, bead));
    square += apart * apart;
  }
  return square;
}

/// Counts, over all frames except the first and last, the turns of beads that are larger than rounding
/// errors.
std::size_t turns(const Frames& frames) {
  std::size_t count = 0;
  for (std::size_t k = 1; k + 1 < frames.size(); ++k)
    for (Eigen::Index b = 0; b < frames[k].cols(); ++b)
      count += (frames[k - 1].col(b) - 2 * frames[k].col(b) + frames[k + 1].col(b)).norm() > 1e-9 ? 1 : 0;
  return count;
}

/// Counts the frames at which a bead moves almost straight on, but by steps that are different doubles.
std::size_t steps_that_differ(const Frames& frames) {
  std::size_t count = 0;
  for (std::size_t k = 1; k + 1 < frames.size(); ++k) {
    for (Eigen::Index b = 0; b < frames[k].cols(); ++b) {
      const Eigen::Vector3d step = frames[k].col(b) - frames[k - 1].col(b),
                            next = frames[k + 1].col(b) - frames[k].col(b);
      count += (next - step).norm() <= 1e-9 && next != step ? 1 : 0;
    }
  }
  return count;
}

// Random walks of all kinds with any number of frames. No exact deviation exceeds the tolerance. At the first
// and last frame beads are near their original places, or exactly there if they rest. Beads turn less often,
// or not at all.
TEST(StraightenedFrames, NeedAllSamples) {
  auto open = std::make_unique<FrameQueue>(std::vector<NecklaceBeads>{{.count = 1}}, 3);
  EXPECT_THROW(StraightenedFrames(std::move(open), 1), std::logic_error);
  auto ended = std::make_unique<FrameQueue>(std::vector<NecklaceBeads>{{.count = 1}}, 3);
  ended->end();
  EXPECT_NO_THROW(StraightenedFrames(std::move(ended), 1));
}

TEST(StraightenedFrames, NeverExceedTheTolerance) {
  std::mt19937 random(61);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int round = 0; round < 60; ++round) {
    SCOPED_TRACE(round);
    const std::size_t count = 1 + random() % 70;
    const double tolerance = std::array{0.0, 0.05, 0.3, 2.0}[static_cast<std::size_t>(round) % 4];
    const double scale = round % 3 == 0 ? 0x1p40 : 1;  // at this scale doubles are coarse
    Frames frames;
    Eigen::Matrix3Xd now = Eigen::Matrix3Xd::NullaryExpr(3, 4, [&] { return scale + uniform(random); });
    for (std::size_t k = 0; k < count; ++k) {
      frames.push_back(now);
      now += 0.1 * Eigen::Matrix3Xd::NullaryExpr(3, 4, [&] { return uniform(random); });
      if (round % 5 == 0) now.col(0) = frames.front().col(0);
    }
    const Frames straight = straightened(frames, tolerance, 1 + round % 2);
    ASSERT_EQ(straight.size(), frames.size());
    const Rational most = Rational(tolerance) * Rational(tolerance);
    for (std::size_t k = 0; k < count; ++k) {
      for (Eigen::Index b = 0; b < 4; ++b) {
        const Rational square = square_of_deviation(frames, straight, k, b);
        ASSERT_LE(square, most);
        if (k == 0 || k + 1 == count) {
          ASSERT_LE(square * 0x1p38, most);
        }
        if (round % 5 == 0 && b == 0) {
          ASSERT_EQ(square, 0);
        }
      }
    }
    if (tolerance == 2.0 && scale == 1 && count > 20) {
      EXPECT_LT(turns(straight) * 4, turns(frames));
    }
    if (tolerance > 0 && scale == 1) {
      EXPECT_EQ(steps_that_differ(straight), 0U);
    }
  }
}

// Among the smallest doubles, the rounding error of a length is as large as the length itself.
TEST(StraightenedFrames, NeverExceedAToleranceOfTheSmallestDoubles) {
  constexpr double smallest = std::numeric_limits<double>::denorm_min();
  std::mt19937 random(62);
  for (int round = 0; round < 200; ++round) {
    Frames frames;
    for (int k = 0; k < 9; ++k)
      frames.push_back(
          Eigen::Matrix3Xd::NullaryExpr(3, 2, [&] { return static_cast<double>(random() % 3) * smallest; }));
    const double tolerance = (1 + round % 3) * smallest;
    const Frames straight = straightened(frames, tolerance);
    for (std::size_t k = 0; k < frames.size(); ++k)
      for (const Eigen::Index bead : {0, 1})
        ASSERT_LE(square_of_deviation(frames, straight, k, bead), Rational(tolerance) * Rational(tolerance));
  }
}

// A bead on a circle, for which a block must be halved twice to come close enough, and a bead that moves
// straight by steps that are not multiples of any grid. All beads are in the plane z = 0.1, and neither means
// nor rounding may leave the plane.
TEST(StraightenedFrames, HalveABlockForTheBeadsThatTurn) {
  Frames frames;
  for (int k = 0; k <= 16; ++k) {
    const double angle = std::numbers::pi * k / 16;
    frames.emplace_back(3, 2);
    frames.back() << std::cos(angle), 0.3 * k, std::sin(angle), 0, 0.1, 0.1;
  }
  // The sagitta of an eighth of a circle is 0.076, and of a quarter 0.29; means lie inside by 0.11.
  const Frames straight = straightened(frames, 0.25);
  EXPECT_EQ(turns(straight), 3U);
  EXPECT_EQ(turns(straightened(frames, 0.45)), 1U);
  EXPECT_EQ(turns(straightened(frames, 1.01)), 0U);
  for (const Eigen::Matrix3Xd& frame : straight) EXPECT_TRUE((frame.row(2).array() == 0.1).all());
}

// Chords from sample to sample would deviate by twice the amplitude of the vibration.
TEST(StraightenedFrames, DoNotFollowVibrations) {
  Frames frames;
  for (int k = 0; k <= 32; ++k) {
    frames.emplace_back(3, 1);
    frames.back() << 0.25 * k, k % 2 == 0 ? 0.1 : -0.1, 0;
  }
  EXPECT_EQ(turns(frames), 31U);
  const Frames straight = straightened(frames, 0.12);
  EXPECT_LT(turns(straight), 10U);  // near the ends
  for (std::size_t k = 8; k + 8 < frames.size(); ++k) EXPECT_LT(std::abs(straight[k](1, 0)), 0.02);
}

// Means and chords of positions near the largest doubles overflow; in that case the samples stay.
TEST(StraightenedFrames, AreFiniteWhereDoublesOverflow) {
  for (const double tolerance : {1e-300, 1.0, 1e305}) {
    Frames frames;
    for (int k = 0; k < 20; ++k) {
      frames.emplace_back(3, 2);
      frames.back() << (k % 3 == 0 ? -1.7e308 : 1.7e308), 1e308, 0, k * 1e306, 1, 1.6e308;
    }
    const Frames straight = straightened(frames, tolerance);
    for (std::size_t k = 0; k < frames.size(); ++k) {
      ASSERT_TRUE(straight[k].allFinite()) << k;
      for (const Eigen::Index bead : {0, 1})
        ASSERT_LE(square_of_deviation(frames, straight, k, bead), Rational(tolerance) * Rational(tolerance));
    }
  }
}

// Beads stay separate for any units and however far the tolerance exceeds the coordinates.
TEST(StraightenedFrames, DoNotRoundBeadsTogether) {
  for (const double unit : {1.0, 0x1p-950, 0x1p-1040, 0x1p930}) {
    for (const double tolerance : {unit, 0x1p60 * unit}) {
      Frames frames;
      for (int k = 0; k <= 20; ++k) {
        frames.emplace_back(3, 2);
        frames.back() << k * unit, k * unit + unit / 8, 0, 0, 0, unit / 16;
      }
      for (const Eigen::Matrix3Xd& frame : straightened(frames, tolerance))
        EXPECT_LT(frame(0, 0), frame(0, 1));
    }
  }
}

}  // namespace
}  // namespace kds::straightened_frames_test
