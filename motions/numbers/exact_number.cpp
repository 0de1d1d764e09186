#include "motions/numbers/exact_number.h"

#include <cmath>
#include <limits>
#include <utility>

namespace kds {

Dyadic::Dyadic(double value) {
  const SplitDouble parts = split(value);
  numerator_ = parts.mantissa;
  if (parts.exponent >= 0) {
    numerator_ <<= static_cast<unsigned>(parts.exponent);
  } else {
    exponent_ = static_cast<unsigned>(-parts.exponent);
  }
}

Dyadic::Dyadic(Integer numerator, unsigned exponent) : numerator_(std::move(numerator)), exponent_(exponent) {
  if (numerator_ == 0) {
    exponent_ = 0;
  } else if (exponent_ > 0) {
    const auto zeros = static_cast<unsigned>(mpz_scan1(numerator_.get_mpz_t(), 0));
    const unsigned shift = zeros < exponent_ ? zeros : exponent_;
    numerator_ >>= shift;
    exponent_ -= shift;
  }
}

Rational Dyadic::rational() const { return fraction(numerator_, Integer(1) << exponent_); }

namespace {

// Rounds towards zero: mpz_get_d_2exp truncates, and scaling the result is exact unless it becomes subnormal.
double truncate(const Integer& numerator, unsigned exponent) {
  long scale = 0;
  const double fraction = mpz_get_d_2exp(&scale, numerator.get_mpz_t());
  const long power = scale - static_cast<long>(exponent);
  if (power > 1024) return std::copysign(std::numeric_limits<double>::max(), fraction);
  if (power < -1021) {  // a subnormal result: truncate to multiples of 2^-1074
    const double unit = std::ldexp(fraction, static_cast<int>(power < -2000 ? -2000L : power) + 1074);
    return std::ldexp(std::trunc(unit), -1074);
  }
  return std::ldexp(fraction, static_cast<int>(power));
}

}  // namespace

double Dyadic::round_down() const {
  const double cut = truncate(numerator_, exponent_);
  if (numerator_ < 0 && !(Dyadic(cut) == *this))
    return std::nextafter(cut, -std::numeric_limits<double>::infinity());
  return cut;
}

double Dyadic::round_up() const {
  const double cut = truncate(numerator_, exponent_);
  if (numerator_ > 0 && !(Dyadic(cut) == *this))
    return std::nextafter(cut, std::numeric_limits<double>::infinity());
  return cut;
}

Dyadic Dyadic::midpoint(const Dyadic& a, const Dyadic& b) {
  const unsigned exponent = a.exponent_ > b.exponent_ ? a.exponent_ : b.exponent_;
  Integer sum = a.numerator_ << (exponent - a.exponent_);
  sum += b.numerator_ << (exponent - b.exponent_);
  return {std::move(sum), exponent + 1};
}

int Dyadic::compare(const Dyadic& a, const Dyadic& b) {
  const int order = a.exponent_ == b.exponent_ ? cmp(a.numerator_, b.numerator_)
                    : a.exponent_ < b.exponent_
                        ? cmp(a.numerator_ << (b.exponent_ - a.exponent_), b.numerator_)
                        : cmp(a.numerator_, b.numerator_ << (a.exponent_ - b.exponent_));
  return (order > 0) - (order < 0);
}

}  // namespace kds
