#pragma once
// Interval arithmetic in double. Enclosures: every result holds the exact results of all operands in its
// operands; ends are moved outwards after rounding to nearest, so the rounding mode stays alone. What
// overflows, and a quotient by or a root of what may be zero, is the whole line.

#include <algorithm>
#include <cmath>
#include <limits>

namespace kds {

struct Interval {
  double lower = 0;
  double upper = 0;

  Interval() = default;
  explicit Interval(double exact) : Interval(exact, exact) {}
  Interval(double low, double high) : lower(low), upper(high) {
    constexpr double most = std::numeric_limits<double>::max();
    if (!(low >= -most && high <= most)) *this = whole();
  }
  [[nodiscard]] static Interval whole() {
    Interval all;
    all.lower = -std::numeric_limits<double>::infinity();
    all.upper = std::numeric_limits<double>::infinity();
    return all;
  }

  /// The least interval that holds both.
  [[nodiscard]] static Interval hull(const Interval& a, const Interval& b) {
    return {std::min(a.lower, b.lower), std::max(a.upper, b.upper)};
  }
  /// What both have in common; they must share a point.
  [[nodiscard]] static Interval common(const Interval& a, const Interval& b) {
    Interval both;
    both.lower = std::max(a.lower, b.lower);
    both.upper = std::min(a.upper, b.upper);
    return both;
  }

  friend Interval operator+(const Interval& a, const Interval& b) {
    return outward(a.lower + b.lower, a.upper + b.upper);
  }
  friend Interval operator-(const Interval& a, const Interval& b) {
    return outward(a.lower - b.upper, a.upper - b.lower);
  }
  friend Interval operator-(const Interval& a) { return {-a.upper, -a.lower}; }
  friend Interval operator*(const Interval& a, const Interval& b) {
    // A NaN, zero times the whole line, comes first or beside infinities, and gives the whole line.
    const auto [low, high] =
        std::minmax({a.lower * b.lower, a.lower * b.upper, a.upper * b.lower, a.upper * b.upper});
    return outward(low, high);
  }
  friend Interval operator/(const Interval& a, const Interval& b) {
    if (!(b.lower > 0 || b.upper < 0)) return whole();
    const auto [low, high] =
        std::minmax({a.lower / b.lower, a.lower / b.upper, a.upper / b.lower, a.upper / b.upper});
    return outward(low, high);
  }
  [[nodiscard]] friend Interval square(const Interval& a) {
    const double near = a.lower > 0 ? a.lower : a.upper < 0 ? -a.upper : 0;
    const double far = std::max(-a.lower, a.upper);
    const Interval result = outward(near * near, far * far);
    return {std::max(result.lower, 0.0), result.upper};
  }
  [[nodiscard]] friend Interval sqrt(const Interval& a) {
    if (!(a.lower > 0)) return whole();
    return outward(std::sqrt(a.lower), std::sqrt(a.upper));
  }

 private:
  /// Moves both ends by at least half a last place, which is what they may err by.
  static Interval outward(double low, double high) {
    return {low - (std::abs(low) * 0x1p-52 + 0x1p-1074), high + (std::abs(high) * 0x1p-52 + 0x1p-1074)};
  }
};

}  // namespace kds
