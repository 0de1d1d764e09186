#include "structures/chord_cages/outward_cages.h"

#include <algorithm>
#include <cmath>

#include "structures/enclosing_sphere/rounded_up.h"

namespace kds {

// Why the growth is enough. Let u = 2^-53. Of a cage that doubles have proved, the radius is the root of the
// greatest square distance computed of a basis bead, and no other bead's is greater (sphere_scan.h); balls
// likewise. Computed distances and their roots err by 4u of themselves. Cages below that were settled as a
// whole lie deeper inside than they err. Of a pair, half the difference of its beads is computed to 2u of
// itself, and the centre, rounded once more, lies u of its coordinates beside the point that belongs to this
// radius. All that is less than 8u of the radius and u of the coordinates; the sum with the common radius of
// beads and the products here take another 4u. Loose cages are measured.
template <int Dimension>
void take_outward(const StaticWrappedHierarchy<Dimension>& hierarchy, const Balls<Dimension>& balls,
                  std::vector<Cage<Dimension>>& cages) {
  const auto known = hierarchy.cages();
  cages.resize(known.size());
  const double wider = hierarchy.wider_than_cages();
  for (NodeId node = 0; node < known.size(); ++node) {
    const Cage<Dimension>& cage = known[node];
    double size = 0;
    for (const double x : cage.center) size += std::abs(x);
    cages[node].center = cage.center;
    cages[node].radius = (cage.radius + wider) * (1 + 0x1p-49) + 0x1p-51 * size;
  }
  for (NodeId node = 0; node < known.size(); ++node) {
    if (!hierarchy.is_loose(node)) continue;
    const BeadRange& range = hierarchy.tree().range(node);
    cages[node].radius = outward_radius(balls, range.first, range.last, cages[node].center);
  }
}

template <int Dimension>
void take_outward(const LayeredHierarchy<Dimension>& hierarchy, const Balls<Dimension>&,
                  std::vector<Cage<Dimension>>& cages) {
  const auto known = hierarchy.cages();
  cages.assign(known.begin(), known.end());
}

template <int Dimension>
double outward_radius(const Balls<Dimension>& balls, BeadId first, BeadId last,
                      const Point<Dimension>& center) {
  double radius = 0;
  for (BeadId b = first; b <= last; ++b)
    radius =
        std::max(radius, reach_rounded_up<Dimension>(center, detail::center_of(balls, b), balls.radius(b)));
  return radius;
}

template void take_outward(const StaticWrappedHierarchy<2>&, const Balls<2>&, std::vector<Cage<2>>&);
template void take_outward(const StaticWrappedHierarchy<3>&, const Balls<3>&, std::vector<Cage<3>>&);
template void take_outward(const LayeredHierarchy<2>&, const Balls<2>&, std::vector<Cage<2>>&);
template void take_outward(const LayeredHierarchy<3>&, const Balls<3>&, std::vector<Cage<3>>&);
template double outward_radius(const Balls<2>&, BeadId, BeadId, const Point<2>&);
template double outward_radius(const Balls<3>&, BeadId, BeadId, const Point<3>&);

}  // namespace kds
