#pragma once
// The unit of length in which floats are looked at.

#include <cmath>

#include "motions/numbers/lanes.h"

namespace kds {

/// Lengths in a unit of 2^exponent: what differences of coordinates, and then of weights, are multiplied by.
/// Exact but where a double overflows, or what is left is below the least float.
class LengthUnit {
 public:
  explicit LengthUnit(int exponent = 0) : scale_(std::ldexp(1.0, -exponent)) {}
  [[nodiscard, gnu::always_inline]] double scale() const { return scale_; }
  /// For coordinates, the weight after them.
  template <int dimension>
  [[nodiscard, gnu::always_inline]] Lanes::Vector scales() const {
    if constexpr (dimension == 3) return Lanes::Vector{scale_, scale_, scale_, scale_ * scale_};
    return Lanes::Vector{scale_, scale_, scale_ * scale_, 0};
  }

 private:
  double scale_;
};

}  // namespace kds
