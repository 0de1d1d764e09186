#pragma once
// The unit of length in which floats are looked at.

#include <cmath>

#include "motions/numbers/lanes.h"

namespace kds {

/// A unit of length 2^exponent, by the factors that bring differences of coordinates and of weights to it.
/// The change is exact unless a double overflows, or the result is below the least float.
class LengthUnit {
 public:
  explicit LengthUnit(int exponent = 0) : scale_(std::ldexp(1.0, -exponent)) {}
  [[nodiscard, gnu::always_inline]] double scale() const { return scale_; }
  /// The factors of a control point's coordinates, then of its weight.
  template <int dimension>
  [[nodiscard, gnu::always_inline]] Lanes::Vector scales() const {
    if constexpr (dimension == 3) return Lanes::Vector{scale_, scale_, scale_, scale_ * scale_};
    return Lanes::Vector{scale_, scale_, scale_ * scale_, 0};
  }

 private:
  double scale_;
};

}  // namespace kds
