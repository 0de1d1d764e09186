#pragma once
// Distances and radii that are never too small: what is rounded is rounded up, whatever the sizes.

#include <cmath>

#include "structures/enclosing_sphere/sphere_of_points.h"

namespace kds {

/// At least |a - b|, by less than 2^-48 of it or of the least normal number; infinite where it overflows.
template <int Dimension>
[[nodiscard]] double distance_rounded_up(const Point<Dimension>& a, const Point<Dimension>& b);

/// At least |a - b| + r, r not negative: how far a ball reaches, seen from a.
template <int Dimension>
[[nodiscard]] double reach_rounded_up(const Point<Dimension>& a, const Point<Dimension>& b, double r) {
  return (distance_rounded_up<Dimension>(a, b) + r) * (1 + 0x1p-51);  // the sum errs by 2^-53 of itself
}

}  // namespace kds
