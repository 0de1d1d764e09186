#pragma once
// A function of time over a piece of a step, enclosed to first order: by its values in the piece's middle,
// its values and its derivatives all over the piece, as intervals. Time is s in [0,1] over the piece. Every
// operation keeps the better of the plain interval result and of the mean value form
// f(1/2) + f'([0,1]) [-1/2, 1/2] (Moore, Interval Analysis, 1966), which on short pieces errs by the square
// of their length only. Enclosures.

#include "certificates/conservative/interval.h"

namespace kds {

struct MeanValue {
  Interval middle, range, slope;

  MeanValue() = default;
  explicit MeanValue(double constant) : middle(constant), range(constant) {}
  MeanValue(const Interval& at_middle, const Interval& all_over, const Interval& derivative)
      : middle(at_middle),
        range(Interval::common(all_over, at_middle + derivative * Interval(-0.5, 0.5))),
        slope(derivative) {}

  friend MeanValue operator+(const MeanValue& a, const MeanValue& b) {
    return {a.middle + b.middle, a.range + b.range, a.slope + b.slope};
  }
  friend MeanValue operator-(const MeanValue& a, const MeanValue& b) {
    return {a.middle - b.middle, a.range - b.range, a.slope - b.slope};
  }
  friend MeanValue operator*(const MeanValue& a, const MeanValue& b) {
    return {a.middle * b.middle, a.range * b.range, a.slope * b.range + a.range * b.slope};
  }
  friend MeanValue operator/(const MeanValue& a, const MeanValue& b) {
    const Interval quotient = a.range / b.range;
    return {a.middle / b.middle, quotient, (a.slope - quotient * b.slope) / b.range};
  }
  [[nodiscard]] friend MeanValue square(const MeanValue& a) {
    return {square(a.middle), square(a.range), Interval(2) * (a.range * a.slope)};
  }
  [[nodiscard]] friend MeanValue sqrt(const MeanValue& a) {
    const Interval root = sqrt(a.range);
    return {sqrt(a.middle), root, a.slope / (Interval(2) * root)};
  }
};

}  // namespace kds
