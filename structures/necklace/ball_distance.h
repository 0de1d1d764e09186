#pragma once
// Exact comparisons of balls whose numbers are doubles. Each one first tries doubles with an error bound,
// then falls back on rationals.

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstddef>

#include "motions/numbers/exact_number.h"

namespace kds {

/// Exactly high + low, where high is the rounded sum.
struct TwoTerms {
  double high, low;
  friend bool operator==(const TwoTerms&, const TwoTerms&) = default;
};

/// Returns a + b exactly. If the sum overflows, `high` is infinite.
[[nodiscard]] inline TwoTerms exact_sum(double a, double b) {
  const double sum = a + b, of_b = sum - a;
  return {sum, (a - (sum - of_b)) + (b - of_b)};
}

/// Computes the sign of a sum of squares of doubles and of their differences, exactly and without heap
/// memory. The total is stored as an expansion, a sum of nonoverlapping doubles (Shewchuk, Adaptive precision
/// floating-point arithmetic and fast robust geometric predicates, 1997). This method takes a tenth of the
/// time of rationals if the differences are exact, which holds for close numbers of equal sign.
class ExactTotal {
 public:
  /// Adds or subtracts the square of a number.
  void add_square(const TwoTerms& x) { add_products(x, 1); }
  void subtract_square(const TwoTerms& x) { add_products(x, -1); }

  /// Returns whether the sign is right: no product overflowed or underflowed.
  [[nodiscard]] bool is_exact() const { return exact_; }
  [[nodiscard]] int sign() const {
    if (size_ == 0) return 0;
    return terms_[size_ - 1] > 0 ? 1 : -1;
  }

 private:
  // Squares of numbers in this range fit into doubles with all their digits.
  static constexpr double least = 0x1p-480, most = 0x1p480;

  void add_products(const TwoTerms& x, double sign) {
    for (const double part : {x.high, x.low}) {
      const double size = std::abs(part);
      exact_ = exact_ && (size == 0 || (size >= least && size <= most));
    }
    if (!exact_) return;
    add_product(x.high, sign * x.high);
    if (x.low == 0) return;
    add_product(2 * x.high, sign * x.low);
    add_product(x.low, sign * x.low);
  }

  // Splits x into halves of 26 bits, whose products are exact (Dekker).
  static TwoTerms halves(double x) {
    const double shifted = 0x1p27 * x + x;
    const double high = shifted - (shifted - x);
    return {high, x - high};
  }
  void add_product(double a, double b) {
    const double product = a * b;
    const TwoTerms p = halves(a), q = halves(b);
    const double error = ((p.high * q.high - product) + p.high * q.low + p.low * q.high) + p.low * q.low;
    add(error);
    add(product);
  }

  // Adds x to the terms, which ascend in size and are never zero.
  void add(double x) {
    std::size_t kept = 0;
    for (std::size_t k = 0; k < size_; ++k) {
      const TwoTerms sum = exact_sum(x, terms_[k]);
      x = sum.high;
      if (sum.low != 0) terms_[kept++] = sum.low;
    }
    if (x != 0) terms_[kept++] = x;
    size_ = kept;
  }

  std::array<double, 48> terms_;  // at most six for each of eight squares
  std::size_t size_ = 0;
  bool exact_ = true;
};

/// The exact, unrounded sum of two doubles.
struct ExactSum {
  double first = 0, second = 0;
};

/// Returns the sign of |a - b|^2 - (r + s)^2 exactly. With the radii of two balls, the sign is positive if
/// the balls are disjoint and zero if they touch from outside. If s is a negated radius, zero means that the
/// balls touch from inside. All arguments are finite.
[[nodiscard]] int compare_distance(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double r, double s);

/// Returns the sign of |a - b|^2 factor^2 - |c - d|^2 exactly. All arguments are finite, and factor is not
/// negative.
[[nodiscard]] int compare_lengths(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double factor,
                                  const Eigen::Vector3d& c, const Eigen::Vector3d& d);

/// Returns the sign of (|a - b| - r) - (|c - d| - s) exactly. The sign says which two balls are farther
/// apart if r and s are the sums of their radii. All arguments are finite.
[[nodiscard]] int compare_gaps(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const ExactSum& r,
                               const Eigen::Vector3d& c, const Eigen::Vector3d& d, const ExactSum& s);

/// Returns the sign of sqrt(p) - (sqrt(q) + u). p and q are not negative.
[[nodiscard]] int compare_gaps(const Rational& p, const Rational& q, const Rational& u);

/// Returns the sign of (|x - a|^2 - v) - (|x - b|^2 - w) exactly: which power is larger at x. All arguments
/// are finite.
[[nodiscard]] int compare_powers(const Eigen::Vector3d& x, const Eigen::Vector3d& a, double v,
                                 const Eigen::Vector3d& b, double w);

/// Returns the sign of x factor - y exactly. All arguments are finite and none is negative.
[[nodiscard]] int compare_products(double x, double factor, double y);

}  // namespace kds
