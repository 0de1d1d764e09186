// The flights and collisions of examples/hard_spheres.h, judged by Boost's integers, which share no code with
// the engine.

#include "examples/hard_spheres.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "tests/support/judges/second_numbers.h"

namespace kds {
namespace {

using test::second::Integer;
using test::second::Rational;
using Vector = std::array<double, 3>;

double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

constexpr double duration = 0.05;  // of a step

struct Line {
  Vector start{}, end{};  // at u = 0 and u = 1 of a step
};

/// The vector from one ball to an image of another, both on lines, in integers. All numbers are multiples of
/// a power of two; `one_` of these units are 1.
class ExactWay {
 public:
  /// Uses the image that is nearest at `when`. Times that are asked for are multiples of 2^-152.
  ExactWay(const Line& a, const Line& b, double edge, double when) {
    std::vector<double> numbers{edge, 0x1p-100};
    for (const Vector& v : {a.start, a.end, b.start, b.end})
      numbers.insert(numbers.end(), v.begin(), v.end());
    unit_ = test::second::unit_of(numbers);
    one_ = Integer(1) << static_cast<unsigned>(-unit_);
    for (int k = 0; k < 3; ++k) {
      const double apart = (1 - when) * (a.start[k] - b.start[k]) + when * (a.end[k] - b.end[k]);
      const Integer shift = whole(edge) * Integer(std::llround(apart / edge));
      start_[k] = whole(a.start[k]) - whole(b.start[k]) - shift;
      way_[k] = whole(a.end[k]) - whole(b.end[k]) - shift - start_[k];
    }
  }
  /// Returns the sign of (distance at u) - 1.
  [[nodiscard]] int distance(double u) const { return (square(at(u)) - one_ * one_ * one_ * one_).sign(); }
  /// Returns the sign of the distance's derivative at u.
  [[nodiscard]] int derivative(double u) const { return product(at(u), way_).sign(); }
  /// Returns whether the balls overlap at any time from `from` to `to`.
  [[nodiscard]] bool overlap(double from, double to) const {
    if (distance(from) < 0 || distance(to) < 0) return true;
    if (derivative(from) >= 0 || derivative(to) <= 0) return false;
    const Integer along = product(start_, way_);  // the least distance is that of two lines
    return square(start_) * square(way_) - along * along < one_ * one_ * square(way_);
  }

 private:
  using Exact = std::array<Integer, 3>;
  static Integer product(const Exact& a, const Exact& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
  static Integer square(const Exact& a) { return product(a, a); }
  [[nodiscard]] Integer whole(double x) const { return test::second::in_units(x, unit_); }
  /// Returns the way at u, multiplied by `one_`.
  [[nodiscard]] Exact at(double u) const {
    Exact place;
    for (int k = 0; k < 3; ++k) place[k] = start_[k] * one_ + way_[k] * whole(u);
    return place;
  }

  int unit_;
  Integer one_;
  Exact start_, way_;
};

/// Follows a run and counts what contradicts the laws of hard spheres.
class FlightJudge {
 public:
  explicit FlightJudge(HardSpheres& balls)
      : balls_(balls), lines_(balls.count()), since_(balls.count()), velocities_(balls.velocities()) {
    balls.on_collision = [this](BeadId i, BeadId j) { collided(i, j); };
  }
  void step() {
    for (BeadId i = 0; i < balls_.count(); ++i) {
      const Line old = lines_[i];
      follow(i, 0);
      jumps += balls_.time > 0 && lines_[i].start != old.end;
    }
    balls_.step();
    for (BeadId i = 0; i < balls_.count(); ++i)
      for (BeadId j = 0; j < i; ++j) judge(i, j, 1);
  }

  std::size_t overlaps = 0, not_meeting = 0, not_approaching = 0, not_receding = 0, jumps = 0,
              not_following = 0, judged_exactly = 0;
  double energy_bound = 0;
  Vector momentum_bound{};

 private:
  [[nodiscard]] Line line_of(BeadId i) const {
    Line line;
    for (int k = 0; k < 3; ++k) {
      line.start[k] = balls_.motion().coordinate(i, 0, k);
      line.end[k] = balls_.motion().coordinate(i, 1, k);
    }
    return line;
  }
  void follow(BeadId i, double since) {
    lines_[i] = line_of(i);
    since_[i] = since;
    for (int k = 0; k < 3; ++k)
      not_following +=
          std::abs(lines_[i].end[k] - lines_[i].start[k] - duration * balls_.velocities()[i][k]) > 1e-13;
  }
  /// Counts an overlap of two balls since one of them changed course. Doubles exclude pairs whose distance is
  /// more than 1 by far more than their rounding errors.
  void judge(BeadId i, BeadId j, double until) {
    const double from = std::max(since_[i], since_[j]), to = std::max(from, until);
    const Line &a = lines_[i], &b = lines_[j];
    Vector apart, way;
    for (int k = 0; k < 3; ++k) {
      const double start = a.start[k] - b.start[k];
      way[k] = a.end[k] - b.end[k] - start;
      apart[k] = start + from * way[k];
      apart[k] -= edge_ * std::round(apart[k] / edge_);
    }
    const double square = dot(way, way), along = dot(apart, way);
    const double most = edge_ / 2 - 1.1;  // on a shorter way only the nearest image comes near
    EXPECT_LT(square, most * most);
    const double first = std::clamp(square > 0 ? -along / square : 0, 0.0, to - from);
    if (dot(apart, apart) + first * (2 * along + first * square) > 1 + 1e-9) return;
    ++judged_exactly;
    overlaps += ExactWay(a, b, edge_, from).overlap(from, to);
  }
  void collided(BeadId i, BeadId j) {
    double lower = balls_.simulator().now().lower(), upper = balls_.simulator().now().upper();
    const ExactWay before(lines_[i], lines_[j], edge_, lower);
    not_meeting += before.distance(lower) < 0 || before.distance(upper) > 0;
    while (upper - lower > 0x1p-50) {
      const double middle = (lower + upper) / 2;
      (before.distance(middle) > 0 ? lower : upper) = middle;
    }
    not_approaching += before.derivative(upper) >= 0;
    judge(i, j, lower);
    for (BeadId other = 0; other < balls_.count(); ++other)
      if (other != i && other != j) {
        judge(i, other, upper);
        judge(j, other, upper);
      }
    for (const BeadId ball : {i, j}) {
      const Line old = lines_[ball];
      follow(ball, lower);
      for (int k = 0; k < 3; ++k) {
        const double jump = lines_[ball].start[k] - old.start[k] +
                            lower * (lines_[ball].end[k] - lines_[ball].start[k] - old.end[k] + old.start[k]);
        jumps += std::abs(jump) > 2e-12;
      }
      // To first order in e = 2^-53, with s the sum of both speeds: the square of the normal errs by 7 e, the
      // approach by 4 e s, and each product or sum by e. So the energy changes by at most 15 e s^2, and 32 e
      // times the squares of both speeds exceeds that. Both balls get the same products, so only the
      // rounding of two sums changes the momentum.
      const auto &v = velocities_[ball], &w = balls_.velocities()[ball];
      energy_bound += 32 * 0x1p-53 * v.squaredNorm();
      for (int k = 0; k < 3; ++k) momentum_bound[k] += 0x1p-53 * std::abs(w[k]);
      velocities_[ball] = w;
    }
    not_receding += ExactWay(lines_[i], lines_[j], edge_, lower).derivative(lower) <= 0;
  }

  HardSpheres& balls_;
  std::vector<Line> lines_;
  std::vector<double> since_;  // when each ball began its line
  std::vector<HardSpheres::Vector> velocities_;
  double edge_ = balls_.motion().cell()[0];
};

struct Conserved {
  Rational energy;
  std::array<Rational, 3> momentum;
};
Conserved conserved(const HardSpheres& balls) {
  Conserved sums;
  for (const HardSpheres::Vector& v : balls.velocities())
    for (int k = 0; k < 3; ++k) {
      sums.energy += Rational(v[k]) * Rational(v[k]) / 2;
      sums.momentum[k] += Rational(v[k]);
    }
  return sums;
}

// KDS_COLLISIONS sets the number of collisions.
TEST(HardSpheres, NeverOverlapAndKeepEnergyAndMomentum) {
  const char* asked = std::getenv("KDS_COLLISIONS");
  const std::size_t collisions = asked == nullptr ? 5000 : std::stoul(asked);
  HardSpheres balls(4, 0.4, duration);
  FlightJudge judge(balls);
  const Conserved before = conserved(balls);
  while (balls.collisions < collisions) judge.step();
  const Conserved after = conserved(balls);
  EXPECT_EQ(judge.overlaps, 0U);
  EXPECT_EQ(judge.not_meeting, 0U);
  EXPECT_EQ(judge.not_approaching, 0U);
  EXPECT_EQ(judge.not_receding, 0U);
  EXPECT_EQ(judge.jumps, 0U);
  EXPECT_EQ(judge.not_following, 0U);
  EXPECT_GT(judge.judged_exactly, balls.collisions);
  EXPECT_LE(abs(after.energy - before.energy), Rational(judge.energy_bound));
  for (int k = 0; k < 3; ++k)
    EXPECT_LE(abs(after.momentum[k] - before.momentum[k]), Rational(judge.momentum_bound[k]));
  std::printf("%zu collisions, %zu pairs judged exactly; energy changed by %.1e of at most %.1e\n",
              balls.collisions, judge.judged_exactly, static_cast<double>(after.energy - before.energy),
              judge.energy_bound);
}

TEST(HardSpheres, CollideAlikeOnIntegers) {
  HardSpheres filtered(2, 0.4, duration), exact(2, 0.4, duration, Kernel::exact);
  while (filtered.collisions < 300) filtered.step();
  while (exact.collisions < 300) exact.step();
  EXPECT_EQ(filtered.simulator().fingerprint(), exact.simulator().fingerprint());
  EXPECT_EQ(filtered.velocities(), exact.velocities());
}

}  // namespace
}  // namespace kds
