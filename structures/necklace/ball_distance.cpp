#include "structures/necklace/ball_distance.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "motions/numbers/exact_number.h"

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

TwoTerms exact_difference(const Eigen::Vector3d& a, const Eigen::Vector3d& b, Eigen::Index axis) {
  return exact_sum(a[axis], -b[axis]);
}

// Returns the sign of left - right if doubles can decide it, else none. Both arguments are nonnegative and
// computed with at most eight roundings in a row, so their relative error is below 2^-49. Underflow in one
// number stays below 2^-1000, which is negligible compared with the larger number. Infinities and NaN give
// none.
std::optional<int> sign_told(double left, double right) {
  constexpr double margin = 1 + 0x1p-48;
  const double larger = std::max(left, right);
  if (!(larger >= 0x1p-900 && larger <= 0x1p1000)) return std::nullopt;
  if (left > right * margin) return 1;
  if (right > left * margin) return -1;
  return std::nullopt;
}

// Returns the sign of e - f sqrt(q), where q is not negative.
int sign_of_difference(const Rational& e, const Rational& f, const Rational& q) {
  const int s = sign_of(e), t = sign_of(f) * sign_of(q);
  if (s != t || s == 0) return s > t ? 1 : s < t ? -1 : 0;
  return s * sign_of(e * e - f * f * q);
}

}  // namespace

int compare_distance(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double r, double s) {
  const double reach = r + s;
  if (const auto sign = sign_told(square_in_double(a, b), reach * reach)) return *sign;
  ExactTotal total;
  for (Eigen::Index axis = 0; axis < 3; ++axis) total.add_square(exact_difference(a, b, axis));
  total.subtract_square(exact_sum(r, s));
  if (total.is_exact()) return total.sign();
  const Rational exact_reach = Rational(r) + Rational(s);
  return sign_of(square_in_rationals(a, b) - exact_reach * exact_reach);
}

int compare_lengths(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double factor,
                    const Eigen::Vector3d& c, const Eigen::Vector3d& d) {
  const double first = square_in_double(a, b), factor_squared = factor * factor;
  if (first >= 0x1p-900 && factor_squared >= 0x1p-900) {  // a factor would magnify the underflow
    if (const auto sign = sign_told(first * factor_squared, square_in_double(c, d))) return *sign;
  }
  const Rational exact_factor(factor);
  return sign_of(square_in_rationals(a, b) * exact_factor * exact_factor - square_in_rationals(c, d));
}

int compare_gaps(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const ExactSum& r,
                 const Eigen::Vector3d& c, const Eigen::Vector3d& d, const ExactSum& s) {
  const double first = std::sqrt(square_in_double(a, b)), second = std::sqrt(square_in_double(c, d));
  const double reach = r.first + r.second, other_reach = s.first + s.second;
  const double sizes = (first + std::abs(reach)) + (second + std::abs(other_reach));
  // Each of the four numbers has a relative error below 2^-50, or an absolute error below 2^-500 if squares
  // underflow.
  const double difference = (first - reach) - (second - other_reach);
  if (sizes <= 0x1p500 && std::abs(difference) > 0x1p-48 * sizes + 0x1p-490) return difference > 0 ? 1 : -1;
  if (exact_sum(r.first, r.second) == exact_sum(s.first, s.second)) {
    ExactTotal total;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      total.add_square(exact_difference(a, b, axis));
      total.subtract_square(exact_difference(c, d, axis));
    }
    if (total.is_exact()) return total.sign();
  }
  return compare_gaps(square_in_rationals(a, b), square_in_rationals(c, d),
                      Rational(r.first) + Rational(r.second) - Rational(s.first) - Rational(s.second));
}

int compare_gaps(const Rational& p, const Rational& q, const Rational& u) {
  const int right = sign_of_difference(u, Rational(-1), q);
  if (right < 0) return 1;
  return sign_of_difference(p - q - u * u, 2 * u, q);
}

int compare_powers(const Eigen::Vector3d& x, const Eigen::Vector3d& a, double v, const Eigen::Vector3d& b,
                   double w) {
  const double first = square_in_double(x, a), second = square_in_double(x, b);
  const double sizes = (first + std::abs(v)) + (second + std::abs(w));
  const double difference = (first - v) - (second - w);
  if (sizes <= 0x1p1000 && std::abs(difference) > 0x1p-48 * sizes + 0x1p-990) return difference > 0 ? 1 : -1;
  return sign_of(square_in_rationals(x, a) - Rational(v) - square_in_rationals(x, b) + Rational(w));
}

int compare_products(double x, double factor, double y) {
  return sign_of(Rational(x) * Rational(factor) - Rational(y));
}

}  // namespace kds
