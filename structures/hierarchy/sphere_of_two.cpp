#include "structures/hierarchy/sphere_of_two.h"

#include <algorithm>
#include <cmath>

#include "structures/enclosing_sphere/rounded_up.h"

namespace kds {

template <int Dimension>
Cage<Dimension> sphere_of_two(const Cage<Dimension>& a, const Cage<Dimension>& b) {
  const double distance = distance_rounded_up<Dimension>(a.center, b.center);
  const double wider = b.radius - a.radius;
  if (distance * (1 + 0x1p-48) <= std::abs(wider)) return wider > 0 ? b : a;
  if (!(std::abs(wider) >= 0)) return a;  // both radii have overflowed
  const double share = std::clamp(0.5 * (1 + wider / distance), 0.0, 1.0);
  Cage<Dimension> cage;
  for (std::size_t axis = 0; axis < Dimension; ++axis)
    cage.center[axis] = (1 - share) * a.center[axis] + share * b.center[axis];
  cage.radius = std::max(reach_rounded_up<Dimension>(cage.center, a.center, a.radius),
                         reach_rounded_up<Dimension>(cage.center, b.center, b.radius));
  return cage;
}

template Cage<2> sphere_of_two(const Cage<2>&, const Cage<2>&);
template Cage<3> sphere_of_two(const Cage<3>&, const Cage<3>&);

}  // namespace kds
