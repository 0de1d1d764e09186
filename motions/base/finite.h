#pragma once
// Checks that control points are finite. NaN and infinity have no exact value, so certificates over them
// would have no function.

#include <cmath>
#include <stdexcept>

namespace kds {

/// Returns the number. Throws std::invalid_argument if it is infinite or a NaN.
[[nodiscard]] inline double finite(double value) {
  if (!std::isfinite(value)) [[unlikely]]
    throw std::invalid_argument("a control point is not a finite number");
  return value;
}

}  // namespace kds
