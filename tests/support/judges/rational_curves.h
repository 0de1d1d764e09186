#pragma once
// A slow and obvious reference for the functions of certificates with constants: polynomials with rational
// coefficients, computed from control points one by one. The file uses nothing of certificates/ except the
// exact polynomial that judges take.

#include <cstddef>
#include <span>
#include <vector>

#include "certificates/exact/exact_polynomial.h"
#include "motions/curves/motion.h"
#include "motions/numbers/bernstein.h"
#include "tests/support/judges/second_numbers.h"

namespace kds::test {

/// Coefficients in scaled Bernstein form.
using RationalCurve = std::vector<second::Rational>;

/// Makes the curve with these control points, or the constant curve if there is only one.
inline RationalCurve rational_curve(std::span<const double> control_points, int degree) {
  RationalCurve curve;
  for (int k = 0; k <= degree; ++k)
    curve.push_back(
        second::Rational(binomial(degree, k)) *
        second::Rational(control_points[control_points.size() == 1 ? 0 : static_cast<std::size_t>(k)]));
  return curve;
}
template <Motion M>
RationalCurve rational_coordinate(const M& motion, BeadId bead, int axis) {
  std::vector<double> control_points;
  for (int k = 0; k <= degree_of(motion); ++k) control_points.push_back(motion.coordinate(bead, k, axis));
  return rational_curve(control_points, degree_of(motion));
}

inline RationalCurve product(const RationalCurve& a, const RationalCurve& b) {
  RationalCurve c(a.size() + b.size() - 1);
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j) c[i + j] += a[i] * b[j];
  return c;
}
/// Adds two curves of any degrees.
inline RationalCurve sum(RationalCurve a, RationalCurve b, int sign = 1) {
  const RationalCurve one{1, 1};  // u + (1-u)
  while (a.size() < b.size()) a = product(a, one);
  while (b.size() < a.size()) b = product(b, one);
  for (std::size_t k = 0; k < a.size(); ++k) a[k] += sign * b[k];
  return a;
}
inline RationalCurve difference(const RationalCurve& a, const RationalCurve& b) { return sum(a, b, -1); }

inline ExactPolynomial exact_polynomial(const RationalCurve& curve, int sign) {
  second::Integer common = 1;
  for (const second::Rational& c : curve) common = lcm(common, denominator(c));
  std::vector<Integer> whole;
  for (const second::Rational& c : curve)
    whole.push_back(second::as_ours(sign * numerator(c) * (common / denominator(c))));
  return ExactPolynomial(std::move(whole));
}

}  // namespace kds::test
