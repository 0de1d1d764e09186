#pragma once
// Computes the smallest sphere around two spheres, with the radius rounded up. The stored sphere, whose
// centre and radius are doubles, holds both stored spheres.
//
// The bound. Let u = 2^-53, D the true distance of centres, w = r_b - r_a, |w| < D, and R half the sum D +
// r_a + r_b. If squares neither overflow nor underflow, the distance has a relative error below 4u and the
// ratio w/D one below 7u, so `share` has an error of 3.5u |w|/D plus u of itself. The centre's error is at
// most 3.5u |w| + 3u share D, which is at most 6.5u R since |w| and share D are at most R, plus u of its
// coordinates. Half the sum of distance and radii has an error of 5u R, and the radius is rounded twice more.
// The sum of these errors is less than 16u R plus u of the coordinates.
//
// One sphere is reported to lie in the other only if this is true in spite of rounding. If it nearly does,
// the centre is the larger sphere's up to the same error, and the radius is no smaller.

#include "structures/enclosing_sphere/cage.h"
#include "structures/enclosing_sphere/four_balls.h"
#include "structures/enclosing_sphere/sphere_of_points.h"

namespace kds {

/// Computes four spheres at once. Requires sizes whose squares neither overflow nor underflow; lanes that are
/// false in the result are not valid. If `equal`, radii must be equal; the code then needs no quotient and
/// gives the same bits.
template <bool equal, int Dimension>
[[gnu::always_inline]] inline Lanes::Mask spheres_of_two(const FourBalls<Dimension>& a,
                                                         const FourBalls<Dimension>& b,
                                                         FourBalls<Dimension>& sphere) {
  const auto d = detail::minus(b.center, a.center);
  const Lanes square = detail::dot(d, d);
  const Lanes distance = NumberTraits<Lanes>::sqrt(square);
  const Lanes wider = b.radius - a.radius;
  // The centre lies on the line of centres, with both far ends on the sphere.
  Lanes share(0.5), reach = Lanes(0.5) * (distance + (a.radius + b.radius));
  if constexpr (!equal) {
    const Lanes middle = Lanes(0.5) * (Lanes(1.0) + wider / square * distance);
    share = Lanes::min(Lanes::max(middle, Lanes(0.0)), Lanes(1.0));
    reach = Lanes::max(reach, Lanes::max(a.radius, b.radius));
  }
  for (std::size_t axis = 0; axis < Dimension; ++axis) sphere.center[axis] = a.center[axis] + share * d[axis];
  Lanes size = abs(sphere.center[0]);
  for (std::size_t axis = 1; axis < Dimension; ++axis) size += abs(sphere.center[axis]);
  sphere.radius = reach * Lanes(1 + 0x1p-49) + Lanes(0x1p-51) * size;
  if constexpr (!equal) {
    const auto nested = distance * Lanes(1 + 0x1p-48) <= abs(wider);
    const auto is_b = wider > Lanes(0.0);
    const auto larger = [&](const Lanes& of_a, const Lanes& of_b, const Lanes& around)
        __attribute__((always_inline)) {
      return Lanes::choose(nested, Lanes::choose(is_b, of_b, of_a), around);
    };
    for (std::size_t axis = 0; axis < Dimension; ++axis)
      sphere.center[axis] = larger(a.center[axis], b.center[axis], sphere.center[axis]);
    sphere.radius = larger(a.radius, b.radius, sphere.radius);
  }
  return (square >= Lanes(0x1p-900)) & (square <= Lanes(0x1p900)) & (abs(wider) >= Lanes(0.0));
}

/// Computes one sphere for any sizes.
template <int Dimension>
[[nodiscard]] Cage<Dimension> sphere_of_two(const Cage<Dimension>& a, const Cage<Dimension>& b);

}  // namespace kds
