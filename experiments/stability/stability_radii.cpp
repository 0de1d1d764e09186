#include "experiments/stability/stability_radii.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace kds {
namespace {

bool has_radii(const BeadCurves& beads) {
  for (std::size_t b = 0; b < beads.bead_count(); ++b)
    for (int k = 0; k <= beads.degree(); ++k)
      if (beads.radius(b, k) != 0) return true;
  return false;
}

// Returns a power of two that is at most an eighth of the distance between beads at the start.
double unit_of(const BeadCurves& beads) {
  double apart = 0;
  for (std::size_t b = 1; b < beads.bead_count(); ++b)
    for (int axis = 0; axis < beads.dimension(); ++axis)
      apart = std::max(apart, std::abs(beads.coordinate(b, 0, axis) - beads.coordinate(0, 0, axis)));
  if (apart == 0) return 1;
  const int exponent = std::isfinite(apart) ? std::ilogb(apart) : 1023;
  return std::max(std::ldexp(1.0, exponent - 3), std::numeric_limits<double>::denorm_min());
}

}  // namespace

void give_radii(BeadCurves& beads, SceneRandom& random) {
  if (has_radii(beads)) return;
  const double unit = unit_of(beads);
  const auto kind = random() % 4;
  const bool equal = kind == 0, changing = kind >= 2, any = kind == 3;
  const auto draw = [&] {
    return unit *
           (any ? 8 * static_cast<double>(random() >> 11U) * 0x1p-53 : static_cast<double>(random() % 9));
  };
  const double common = draw();
  for (std::size_t b = 0; b < beads.bead_count(); ++b) {
    const double radius = equal ? common : draw();
    for (int k = 0; k <= beads.degree(); ++k) beads.radius(b, k) = changing && k > 0 ? draw() : radius;
  }
}

}  // namespace kds
