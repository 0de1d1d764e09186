#pragma once
// Distances and radii that are never too small: results are rounded up for numbers of any size.

#include <cmath>

#include "structures/enclosing_sphere/sphere_of_points.h"

namespace kds {

/// Returns at least |a - b|. The excess is below 2^-48 of the result or of the least normal number. Infinite
/// on overflow.
template <int Dimension>
[[nodiscard]] double distance_rounded_up(const Point<Dimension>& a, const Point<Dimension>& b);

/// Returns at least |a - b| + r, the distance from a to the farthest point of the ball. r is not negative.
template <int Dimension>
[[nodiscard]] double reach_rounded_up(const Point<Dimension>& a, const Point<Dimension>& b, double r) {
  return (distance_rounded_up<Dimension>(a, b) + r) * (1 + 0x1p-51);  // the sum has a relative error of 2^-53
}

}  // namespace kds
