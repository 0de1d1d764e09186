#pragma once
// Points, determinants and linear systems over rationals, solved by elimination. Tests judge certificates
// by these. Positions are rationals that share no code with the product's. The judge enclosing_ball.h uses
// the product's rationals, which are several times faster.

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "motions/curves/bezier_motion.h"
#include "motions/views/integer_view.h"
#include "tests/support/judges/second_numbers.h"

namespace kds::test {

template <class Number>
using PointOf = std::array<Number, 3>;
template <class Number>
using MatrixOf = std::vector<std::vector<Number>>;
using RationalPoint = PointOf<second::Rational>;
using Matrix = MatrixOf<second::Rational>;

inline int sign(const second::Rational& x) { return x.sign(); }

template <class Number>
Number determinant_of(MatrixOf<Number> m) {
  Number result = 1;
  for (std::size_t column = 0; column < m.size(); ++column) {
    std::size_t pivot = column;
    while (pivot < m.size() && m[pivot][column] == 0) ++pivot;
    if (pivot == m.size()) return 0;
    if (pivot != column) {
      std::swap(m[pivot], m[column]);
      result = -result;
    }
    result *= m[column][column];
    for (std::size_t row = column + 1; row < m.size(); ++row) {
      const Number factor = m[row][column] / m[column][column];
      for (std::size_t k = column; k < m.size(); ++k) m[row][k] -= factor * m[column][k];
    }
  }
  return result;
}

/// Solves m x = b by Cramer's rule; returns nothing if m is singular.
template <class Number>
std::optional<std::vector<Number>> solve(const MatrixOf<Number>& m, const std::vector<Number>& b) {
  const Number whole = determinant_of(m);
  if (whole == 0) return std::nullopt;
  std::vector<Number> x;
  for (std::size_t column = 0; column < m.size(); ++column) {
    MatrixOf<Number> replaced = m;
    for (std::size_t row = 0; row < m.size(); ++row) replaced[row][column] = b[row];
    x.push_back(determinant_of(replaced) / whole);
  }
  return x;
}

template <class Number>
Number dot(const PointOf<Number>& a, const PointOf<Number>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <class Number>
PointOf<Number> minus(const PointOf<Number>& a, const PointOf<Number>& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

/// Returns the barycentric coordinates of the centre of the smallest sphere through the points, in their
/// affine hull. Returns nothing if the points are affinely dependent.
inline std::optional<std::vector<second::Rational>> circumcenter(std::span<const RationalPoint> points) {
  // sum_i l_i = 1 and |c - p_0|^2 = |c - p_k|^2, that is 2 (p_k - p_0) . (c - p_0) = |p_k - p_0|^2
  const std::size_t n = points.size();
  Matrix m(n, std::vector<second::Rational>(n, 1));
  std::vector<second::Rational> b(n, 1);
  for (std::size_t k = 1; k < n; ++k) {
    const RationalPoint d = minus(points[k], points[0]);
    for (std::size_t i = 0; i < n; ++i) m[k][i] = 2 * dot(d, minus(points[i], points[0]));
    b[k] = dot(d, d);
  }
  return solve(m, b);
}

template <class Number>
PointOf<Number> combination(const std::vector<PointOf<Number>>& points, const std::vector<Number>& weights) {
  PointOf<Number> sum{};
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) sum[axis] += weights[i] * points[i][axis];
  }
  return sum;
}

/// Returns the sign of a certificate's function at a time, from the exact positions at that time.
template <class Certificate, Motion M>
int sign_at(const Certificate& certificate, const M& motion, const Dyadic& time) {
  const auto function = function_of(certificate, MomentView<M>(motion, certificate.beads, time));
  static_assert(decltype(function)::degree == 0);
  return (function.scaled[0] > 0) - (function.scaled[0] < 0);
}

/// Returns the value at a time of a bead's control numbers: number(bead, k), for k from 0 to the degree.
template <Motion M, class Number>
second::Rational value_at(const M& motion, const Dyadic& time, Number number) {
  std::vector<double> control_numbers;
  for (int k = 0; k <= degree_of(motion); ++k) control_numbers.push_back(number(k));
  return second::value(control_numbers, second::of(time));
}
template <Motion M>
RationalPoint point_at(const M& motion, BeadId bead, const Dyadic& time) {
  RationalPoint point{};
  for (int axis = 0; axis < M::dimension; ++axis)
    point[static_cast<std::size_t>(axis)] =
        value_at(motion, time, [&](int k) { return motion.coordinate(bead, k, axis); });
  return point;
}
template <Motion M>
second::Rational weight_at(const M& motion, BeadId bead, const Dyadic& time) {
  return value_at(motion, time, [&](int k) { return motion.weight(bead, k); });
}
template <Motion M>
second::Rational radius_at(const M& motion, BeadId bead, const Dyadic& time) {
  return value_at(motion, time, [&](int k) { return motion.radius(bead, k); });
}

/// Makes a motion of beads at rest.
inline BezierMotion<3, 1> at_rest(std::span<const std::array<double, 3>> points,
                                  std::span<const double> weights = {}) {
  BezierMotion<3, 1> motion(points.size());
  for (BeadId b = 0; b < points.size(); ++b) {
    for (int k = 0; k <= 1; ++k) {
      for (int axis = 0; axis < 3; ++axis)
        motion.set_coordinate(b, k, axis, points[b][static_cast<std::size_t>(axis)]);
      if (!weights.empty()) motion.set_weight(b, k, weights[b]);
    }
  }
  return motion;
}

}  // namespace kds::test
