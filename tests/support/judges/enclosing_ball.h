#pragma once
// Computes the sphere that encloses and touches some balls at one time, from its definition over rationals.
// Elimination gives the centre, and the only square root is enclosed to any requested precision. The judge
// uses nothing of certificates/. Its numbers are the product's: with Boost's, its tests take several times as
// long.

#include <optional>
#include <span>
#include <vector>

#include "motions/curves/positions.h"
#include "tests/support/judges/rational_geometry.h"

namespace kds::test {

/// A number known to lie in the interval [lower, upper].
struct Enclosed {
  Rational lower, upper;

  Enclosed() = default;
  Enclosed(const Rational& exact) : lower(exact), upper(exact) {}
  Enclosed(Rational low, Rational high) : lower(std::move(low)), upper(std::move(high)) {}

  /// 1 or -1; 0 means zero or undecided.
  [[nodiscard]] int sign() const { return lower > 0 ? 1 : upper < 0 ? -1 : 0; }

  friend Enclosed operator+(const Enclosed& a, const Enclosed& b) {
    return {Rational(a.lower + b.lower), Rational(a.upper + b.upper)};
  }
  friend Enclosed operator-(const Enclosed& a, const Enclosed& b) {
    return {Rational(a.lower - b.upper), Rational(a.upper - b.lower)};
  }
  friend Enclosed operator*(const Enclosed& a, const Enclosed& b) {
    const Rational products[] = {a.lower * b.lower, a.lower * b.upper, a.upper * b.lower, a.upper * b.upper};
    return {*std::min_element(products, products + 4), *std::max_element(products, products + 4)};
  }
};

/// Encloses a square root to `bits` relative bits. The result is exact if the root is rational.
inline Enclosed square_root(const Rational& x, unsigned bits) {
  const Integer n = numerator(x);
  const Integer d = denominator(x);
  // sqrt(n/d) = sqrt(n d) / d
  const Integer square = (n * d) << (2 * bits);
  const Integer root = sqrt(square);
  const Integer whole = d << bits;
  if (root * root == square) return fraction(root, whole);
  return {fraction(root, whole), fraction(root + 1, whole)};
}

using BallCenter = PointOf<Rational>;
struct Ball {
  BallCenter center{};
  Rational radius;
};

template <Motion M>
Ball ball_at(const M& motion, BeadId bead, const Dyadic& time) {
  Ball ball{{}, exact_radius(motion, bead, time)};
  const auto position = exact_position(motion, bead, time);
  std::copy_n(position.begin(), M::dimension, ball.center.begin());
  return ball;
}

/// The smallest sphere that encloses and touches all balls of a basis, relative to the first ball.
struct TouchingSphere {
  std::array<Enclosed, 3> center;  ///< minus the first ball's centre
  Enclosed radius;                 ///< minus the first ball's radius
  std::vector<Enclosed> shares;    ///< barycentric coordinates of the centre

  /// Returns whether the centre lies in the interior of the convex hull of the centres. In that case the
  /// sphere is the smallest enclosing sphere and no ball of the basis is superfluous.
  [[nodiscard]] bool is_proper() const {
    return std::all_of(shares.begin(), shares.end(), [](const Enclosed& x) { return x.sign() > 0; });
  }
  /// Returns 1 for inside, 0 for inside and touching (or undecided), -1 for not inside.
  [[nodiscard]] int holds(const Ball& first, const Ball& ball) const {
    const Enclosed room = radius - Enclosed(ball.radius - first.radius);
    if (room.sign() < 0) return -1;
    const BallCenter d = minus(ball.center, first.center);
    Enclosed distance(0);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Enclosed along = center[axis] - Enclosed(d[axis]);
      distance = distance + along * along;
    }
    return (room * room - distance).sign();
  }
};

/// Returns nothing if no such sphere exists or the centres are affinely dependent.
inline std::optional<TouchingSphere> touching_sphere(std::span<const Ball> basis, unsigned bits = 300) {
  const std::size_t m = basis.size() - 1;
  std::vector<BallCenter> d(m);
  MatrixOf<Rational> gram(m, std::vector<Rational>(m));
  std::vector<Rational> e(m);
  std::vector<Rational> s(m);
  for (std::size_t i = 0; i < m; ++i) {
    d[i] = minus(basis[i + 1].center, basis[0].center);
    s[i] = basis[i + 1].radius - basis[0].radius;
    e[i] = (dot(d[i], d[i]) - s[i] * s[i]) / 2;
  }
  for (std::size_t i = 0; i < m; ++i) {
    for (std::size_t j = 0; j < m; ++j) gram[i][j] = dot(d[i], d[j]);
  }
  // Solves d_i . z = e_i + s_i rho: the centre is p + rho q, with barycentric coordinates y + rho w.
  const auto y = solve(gram, e);
  const auto w = solve(gram, s);
  if (!y || !w) return std::nullopt;
  const BallCenter p = combination(d, *y);
  const BallCenter q = combination(d, *w);
  const Rational a = dot(q, q) - 1;
  const Rational b = dot(p, q);
  const Rational c = dot(p, p);

  std::vector<Enclosed> roots;  // roots of a rho^2 + 2 b rho + c
  if (a == 0) {
    if (b != 0) roots.emplace_back(Rational(-c / (2 * b)));
  } else {
    const Rational square = b * b - a * c;
    if (square < 0) return std::nullopt;
    const Enclosed root = square_root(square, bits);
    const Enclosed over(Rational(1 / a));
    roots.push_back((Enclosed(Rational(-b)) - root) * over);
    roots.push_back((Enclosed(Rational(-b)) + root) * over);
  }
  std::optional<TouchingSphere> smallest;
  for (const Enclosed& rho : roots) {
    bool touches = rho.lower >= 0;
    for (const Rational& x : s) touches &= rho.lower >= x;
    if (!touches || (smallest && smallest->radius.lower <= rho.lower)) continue;
    smallest.emplace();
    smallest->radius = rho;
    for (std::size_t axis = 0; axis < 3; ++axis)
      smallest->center[axis] = Enclosed(p[axis]) + Enclosed(q[axis]) * rho;
    smallest->shares.emplace_back(Rational(1));
    for (std::size_t i = 0; i < m; ++i) {
      smallest->shares.push_back(Enclosed((*y)[i]) + Enclosed((*w)[i]) * rho);
      smallest->shares[0] = smallest->shares[0] - smallest->shares.back();
    }
  }
  return smallest;
}

}  // namespace kds::test
