#pragma once
// The unit of length for views in floats.

#include <cmath>

#include "motions/numbers/lanes.h"

namespace kds {

/// A unit of length 2^exponent, as the factors that convert differences of coordinates and of weights to it.
/// The conversion is exact unless a double overflows or the result is below the smallest float.
class LengthUnit {
 public:
  explicit LengthUnit(int exponent = 0) : scale_(std::ldexp(1.0, -exponent)) {}
  [[nodiscard, gnu::always_inline]] double scale() const { return scale_; }
  /// Returns the factors of a control point's coordinates, then of its weight.
  template <int dimension>
  [[nodiscard, gnu::always_inline]] Lanes::Vector scales() const {
    if constexpr (dimension == 3) return Lanes::Vector{scale_, scale_, scale_, scale_ * scale_};
    return Lanes::Vector{scale_, scale_, scale_ * scale_, 0};
  }

 private:
  double scale_;
};

}  // namespace kds
