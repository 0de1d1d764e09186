#pragma once
// Control points are finite numbers: what is neither has no exact value, and no certificate a function.

#include <cmath>
#include <stdexcept>

namespace kds {

/// The number itself. Throws std::invalid_argument where it is infinite or none.
[[nodiscard]] inline double finite(double value) {
  if (!std::isfinite(value)) [[unlikely]]
    throw std::invalid_argument("a control point is not a finite number");
  return value;
}

}  // namespace kds
