#include "structures/ball_distance.h"

#include <algorithm>
#include <optional>

#include "motions/exact_number.h"

namespace kds {

namespace {

double square_in_double(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
  return x * x + y * y + z * z;
}

Rational square_in_rationals(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  Rational sum = 0;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const Rational x = Rational(a[axis]) - Rational(b[axis]);
    sum += x * x;
  }
  return sum;
}

int sign_of(const Rational& x) { return (x > 0) - (x < 0); }

// The sign of the difference of two numbers that are not negative, each computed with at most eight roundings
// in a row, hence with a relative error below 2^-49, if they tell it. What underflows in one of them is below
// 2^-1000, which does not matter beside the larger one; infinities and NaN tell nothing.
std::optional<int> sign_told(double left, double right) {
  constexpr double margin = 1 + 0x1p-48;
  const double larger = std::max(left, right);
  if (!(larger >= 0x1p-900 && larger <= 0x1p1000)) return std::nullopt;
  if (left > right * margin) return 1;
  if (right > left * margin) return -1;
  return std::nullopt;
}

}  // namespace

int compare_distance(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double r, double s) {
  const double reach = r + s;
  if (const auto sign = sign_told(square_in_double(a, b), reach * reach)) return *sign;
  const Rational exact_reach = Rational(r) + Rational(s);
  return sign_of(square_in_rationals(a, b) - exact_reach * exact_reach);
}

int compare_lengths(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double factor,
                    const Eigen::Vector3d& c, const Eigen::Vector3d& d) {
  const double first = square_in_double(a, b), factor_squared = factor * factor;
  if (first >= 0x1p-900 && factor_squared >= 0x1p-900) {  // a factor would magnify what underflowed
    if (const auto sign = sign_told(first * factor_squared, square_in_double(c, d))) return *sign;
  }
  const Rational exact_factor(factor);
  return sign_of(square_in_rationals(a, b) * exact_factor * exact_factor - square_in_rationals(c, d));
}

int compare_products(double x, double factor, double y) {
  return sign_of(Rational(x) * Rational(factor) - Rational(y));
}

}  // namespace kds
