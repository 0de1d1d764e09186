#pragma once
// Exact numbers: integers without a width, and dyadic rationals, which is what doubles are.

#include <boost/multiprecision/gmp.hpp>

namespace kds {

using Integer = boost::multiprecision::number<boost::multiprecision::gmp_int, boost::multiprecision::et_off>;
using Rational =
    boost::multiprecision::number<boost::multiprecision::gmp_rational, boost::multiprecision::et_off>;

/// value = mantissa * 2^exponent with an odd mantissa, or 0 * 2^0. `value` must be finite.
struct SplitDouble {
  long long mantissa = 0;
  int exponent = 0;
};
[[nodiscard]] SplitDouble split(double value);

/// numerator / 2^exponent; kept with an odd numerator or exponent 0.
class Dyadic {
 public:
  Dyadic() = default;
  explicit Dyadic(double value);
  Dyadic(Integer numerator, unsigned exponent);

  [[nodiscard]] const Integer& numerator() const { return numerator_; }
  [[nodiscard]] unsigned exponent() const { return exponent_; }
  [[nodiscard]] Rational rational() const;

  /// The largest double not above, the smallest not below.
  [[nodiscard]] double round_down() const;
  [[nodiscard]] double round_up() const;

  [[nodiscard]] static Dyadic midpoint(const Dyadic& a, const Dyadic& b);
  [[nodiscard]] static int compare(const Dyadic& a, const Dyadic& b);
  friend bool operator==(const Dyadic& a, const Dyadic& b) { return compare(a, b) == 0; }
  friend bool operator<(const Dyadic& a, const Dyadic& b) { return compare(a, b) < 0; }
  friend bool operator<=(const Dyadic& a, const Dyadic& b) { return compare(a, b) <= 0; }

 private:
  Integer numerator_ = 0;
  unsigned exponent_ = 0;
};

}  // namespace kds
