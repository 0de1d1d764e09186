#pragma once
// Random motions of a basis of balls and one further ball, and a judge that decides from the definition
// whether that ball is inside the basis' sphere.

#include <cmath>
#include <optional>
#include <vector>

#include "certificates/types/ball_in_sphere.h"
#include "certificates/types/orientation.h"
#include "tests/support/inputs/random_motion.h"
#include "tests/support/judges/enclosing_ball.h"

namespace kds::test {

template <int Dimension, int Size, int Degree>
struct BallCase {
  static constexpr int dimension = Dimension;
  static constexpr int size = Size;
  using M = BezierMotion<Dimension, Degree>;
  using C = BallInSphere<Dimension, Size>;
};

/// The corners of a simplex around the origin.
inline constexpr double corners[2][4][3] = {{{1, 0, 0}, {-0.5, 0.75, 0}, {-0.5, -0.75, 0}, {0, 0, 0}},
                                            {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}};

/// Parameters that map random numbers to balls; most are placed around a good basis.
struct BallShape {
  double noise = 0.3;
  double motion = 0.3;
  double largest_radius = 0.5;
  double reach = 1.5;  // distance factor of the last ball
  bool whole = false;  // round to multiples of 1/4, which makes tangencies and coincidences
  bool changing = true;
};

template <class T>
typename T::M motion_of(Random& random, const BallShape& shape) {
  typename T::M motion(T::size + 1);
  const auto number = [&](double x) { return shape.whole ? 0.25 * std::round(4 * x) : x; };
  for (BeadId b = 0; b <= T::size; ++b) {
    const double radius = uniform(random, 0, shape.largest_radius);
    for (int axis = 0; axis < T::dimension; ++axis) {
      const double x = b == T::size
                           ? uniform(random, -shape.reach, shape.reach)
                           : corners[T::dimension - 2][b][axis] + uniform(random, -shape.noise, shape.noise);
      for (int k = 0; k <= T::M::degree; ++k) {
        const double step = b == T::size ? shape.reach : shape.motion;
        motion.set_coordinate(b, k, axis, number(x + (k > 0 ? uniform(random, -step, step) : 0)));
      }
    }
    for (int k = 0; k <= T::M::degree; ++k) {
      const double change = k > 0 && shape.changing ? uniform(random, -0.3, 0.3) : 0;
      motion.set_radius(b, k, number(radius * (1 + change)));
    }
  }
  return motion;
}

template <class C, class M>
C certificate_at(const M& motion, const Dyadic& time, bool inside = true) {
  C certificate;
  for (std::size_t i = 0; i < certificate.beads.size(); ++i) certificate.beads[i] = static_cast<BeadId>(i);
  certificate.inside = inside;
  if constexpr (C::full) {
    Orientation<M::dimension> orientation;
    for (std::size_t i = 0; i < orientation.beads.size(); ++i) orientation.beads[i] = static_cast<BeadId>(i);
    certificate.orientation = kds::test::sign_at(orientation, motion, time) < 0 ? -1 : 1;
  }
  return certificate;
}

/// Returns the judge's answer: 1, 0 or -1. Returns nothing if the basis is not proper at that time.
template <class M>
std::optional<int> judged_inside(const M& motion, const Dyadic& time) {
  std::vector<Ball> balls;
  for (BeadId b = 0; b < motion.bead_count(); ++b) balls.push_back(ball_at(motion, b, time));
  const auto sphere = touching_sphere(std::span(balls).first(balls.size() - 1));
  if (!sphere || !sphere->is_proper()) return std::nullopt;
  return sphere->holds(balls.front(), balls.back());
}

}  // namespace kds::test
