#pragma once
// The smallest sphere around two spheres, radius rounded up: as it stands, centre and radius doubles, it
// holds both as they stand.
//
// The bound. With u = 2^-53, D the true distance of centres, w = r_b - r_a, |w| < D, and R = (D + r_a + r_b)
// / 2: where squares neither over- nor underflow the distance errs by less than 4u of itself and the ratio w
// / D by less than 7u of itself, so that `share` errs by 3.5u |w| / D and u of itself. The centre is where it
// should be up to 3.5u |w| + 3u share D, at most 6.5u R since |w| and share D are at most R, and u of its
// coordinates; half the sum of distance and radii errs by 5u R, and the radius is rounded twice more. All
// that is less than 16u R and u of the coordinates. One sphere lies in the other only if that is true in
// spite of rounding. Where it all but does the centre is that of the larger, up to as much, and the radius no
// less.

#include "structures/enclosing_sphere/cage.h"
#include "structures/enclosing_sphere/four_balls.h"
#include "structures/enclosing_sphere/sphere_of_points.h"

namespace kds {

/// Four at once, where squares of sizes neither over- nor underflow: lanes that are false are no such sphere.
/// Two of equal radii, which must be those, need no quotient: the same bits.
template <bool equal, int Dimension>
[[gnu::always_inline]] inline Lanes::Mask spheres_of_two(const FourBalls<Dimension>& a,
                                                         const FourBalls<Dimension>& b,
                                                         FourBalls<Dimension>& sphere) {
  const auto d = detail::minus(b.center, a.center);
  const Lanes square = detail::dot(d, d);
  const Lanes distance = NumberTraits<Lanes>::sqrt(square);
  const Lanes wider = b.radius - a.radius;
  // On the line of centres: both far ends on the sphere.
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

/// One, of any sizes.
template <int Dimension>
[[nodiscard]] Cage<Dimension> sphere_of_two(const Cage<Dimension>& a, const Cage<Dimension>& b);

}  // namespace kds
