#pragma once
// Checks whether spheres that move along Bezier curves contain the balls of their nodes at a given time. The
// check follows the definition over rationals in the power basis, and uses nothing of structures/ except the
// tree and the spheres.

#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "motions/curves/positions.h"
#include "structures/enclosing_sphere/cage.h"
#include "structures/necklace/necklace_tree.h"

namespace kds::test {

/// Evaluates the Bernstein polynomial with these control numbers at u.
inline Rational bernstein_sum(const std::vector<double>& control_numbers, const Rational& u) {
  const int degree = static_cast<int>(control_numbers.size()) - 1;
  Rational sum = 0;
  for (int k = 0; k <= degree; ++k) {
    Rational term = Rational(binomial(degree, k)) * Rational(control_numbers[static_cast<std::size_t>(k)]);
    for (int i = 0; i < degree; ++i) term *= i < k ? u : Rational(1 - u);
    sum += term;
  }
  return sum;
}

/// Returns a ball of a motion at a time.
template <int D>
struct BallAt {
  std::array<Rational, D> center;
  Rational radius;
};
template <int D, class M>
BallAt<D> ball_of(const M& motion, BeadId bead, const Rational& u) {
  BallAt<D> ball;
  std::vector<double> numbers;
  for (int axis = 0; axis <= D; ++axis) {
    numbers.clear();
    for (int k = 0; k <= degree_of(motion); ++k)
      numbers.push_back(axis < D ? motion.coordinate(bead, k, axis) : motion.radius(bead, k));
    (axis < D ? ball.center[static_cast<std::size_t>(axis)] : ball.radius) = bernstein_sum(numbers, u);
  }
  return ball;
}

/// Returns the sphere with these control spheres at a time.
template <int D>
BallAt<D> sphere_of(const std::vector<Cage<D>>& controls, const Rational& u) {
  BallAt<D> sphere;
  std::vector<double> numbers;
  for (std::size_t axis = 0; axis <= D; ++axis) {
    numbers.clear();
    for (const Cage<D>& cage : controls) numbers.push_back(axis < D ? cage.center[axis] : cage.radius);
    (axis < D ? sphere.center[axis] : sphere.radius) = bernstein_sum(numbers, u);
  }
  return sphere;
}

template <int D>
bool holds(const BallAt<D>& sphere, const BallAt<D>& ball) {
  Rational square = 0;
  for (std::size_t axis = 0; axis < D; ++axis) {
    const Rational d = sphere.center[axis] - ball.center[axis];
    square += d * d;
  }
  const Rational room = sphere.radius - ball.radius;
  return room >= 0 && square <= room * room;
}

/// Reports each ball that is not contained in a node's sphere at time u of the motion, which is time
/// `of_cage` of the spheres' curve.
template <int D, class M>
std::optional<std::string> sticks_out(const M& motion, const BeadRange& range,
                                      const std::vector<Cage<D>>& controls, const Rational& u,
                                      const Rational& of_cage) {
  for (const Cage<D>& cage : controls)
    if (std::isinf(cage.radius)) return std::nullopt;
  const BallAt<D> sphere = sphere_of<D>(controls, of_cage);
  for (BeadId b = range.first; b <= range.last; ++b)
    if (!holds(sphere, ball_of<D>(motion, b, u)))
      return "bead " + std::to_string(b) + " of " + std::to_string(range.first) + "-" +
             std::to_string(range.last) + " at u = " + u.get_str();
  return std::nullopt;
}

}  // namespace kds::test
