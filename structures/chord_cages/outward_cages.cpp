#include "structures/chord_cages/outward_cages.h"

#include <algorithm>
#include <type_traits>

#include "structures/enclosing_sphere/rounded_up.h"

namespace kds {

namespace {

// Proof that these shares suffice. Let u = 2^-53.
// - Cages that doubles have proved: the radius is the root of the greatest computed squared distance of a
//   basis bead, and no other bead has a greater one (sphere_scan.h). Balls are treated alike. Computed
//   distances and their roots have relative errors of at most 4u.
// - Cages below a proved cage that were settled as a whole lie deeper inside than this error.
// - Pairs: half the distance of the two beads is computed to 2u of itself. The centre is rounded once more
//   and lies within u of its coordinates of the point that belongs to this radius.
//
// The sum of these errors is less than 8u of the radius and u of the coordinates. The sum with the common
// radius of the beads and the products add another 4u. Loose cages are measured instead.
constexpr double of_radius = 0x1p-49, of_center = 0x1p-51;

}  // namespace

template <class Hierarchy>
void TakenCages<Hierarchy>::take(Hierarchy& hierarchy,
                                 [[maybe_unused]] const typename Hierarchy::BallsAt& balls) {
  hierarchy.exchange_cages(cages_);
  if constexpr (std::is_same_v<Hierarchy, StaticWrappedHierarchy<dimension>>) {
    wider_ = hierarchy.wider_than_cages();
    hierarchy.visit_loose([&](NodeId node) {
      const BeadRange& range = hierarchy.tree().range(node);
      Cage<dimension>& cage = cages_[node];
      cage.radius = 0;
      for (BeadId b = range.first; b <= range.last; ++b)
        cage.radius =
            std::max(cage.radius, reach_rounded_up<dimension>(cage.center, detail::center_of(balls, b),
                                                              balls.equal_radii() ? 0 : balls.radius(b)));
    });
  }
}

// A layered hierarchy rounds its radii up itself.
template <class Hierarchy>
auto TakenCages<Hierarchy>::outward() const -> OutwardCages<dimension> {
  if (std::is_same_v<Hierarchy, LayeredHierarchy<dimension>>) return OutwardCages<dimension>(cages_, 0, 0, 0);
  return OutwardCages<dimension>(cages_, wider_, of_radius, of_center);
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

template class TakenCages<StaticWrappedHierarchy<2>>;
template class TakenCages<StaticWrappedHierarchy<3>>;
template class TakenCages<LayeredHierarchy<2>>;
template class TakenCages<LayeredHierarchy<3>>;
template double outward_radius(const Balls<2>&, BeadId, BeadId, const Point<2>&);
template double outward_radius(const Balls<3>&, BeadId, BeadId, const Point<3>&);

}  // namespace kds
