#include "structures/chord_cages/chord_cages.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <type_traits>
#include <utility>

#include "motions/base/floating_point_scope.h"
#include "motions/base/input_error.h"
#include "structures/enclosing_sphere/cage.h"

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

template <int D>
void bring_to(StaticWrappedHierarchy<D>& hierarchy, const Balls<D>& balls) {
  (void)hierarchy.update(balls);
}
template <int D>
void bring_to(LayeredHierarchy<D>& hierarchy, const BallRows<D>& balls) {
  hierarchy.build(balls);
}

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

template <class Hierarchy>
ChordCages<Hierarchy>::ChordCages(std::span<const BeadRange> necklaces, int degree, bool keep_bases)
    : hierarchy_(necklaces),
      balls_(static_cast<std::size_t>(degree) + 1),
      cages_(static_cast<std::size_t>(degree) + 1),
      keep_bases_(keep_bases) {}

template <class Hierarchy>
void ChordCages<Hierarchy>::take(int k) {
  const auto index = static_cast<std::size_t>(k);
  bring_to(hierarchy_, balls_[index]);
  cages_[index].take(hierarchy_, balls_[index]);
  // No sphere is larger than the one at the root of its necklace.
  for (NodeId root = 0; root < tree().node_count();
       root += tree().range(root).last - tree().range(root).first)
    if (!std::isfinite(cages(k)[root].radius))
      throw InputError("the sphere around beads " + std::to_string(tree().range(root).first) + " to " +
                       std::to_string(tree().range(root).last) +
                       " exceeds the range of numbers; give all lengths in a larger unit");
}

template <class Hierarchy>
void ChordCages<Hierarchy>::build(const Curves<dimension>& curves) {
  const FloatingPointScope to_nearest;
  moved_ = false;
  balls_.front().move_to(curves, 0);
  take(0);
}

template <class Hierarchy>
void ChordCages<Hierarchy>::move_to(const Curves<dimension>& curves) {
  const FloatingPointScope to_nearest;
  if (moved_) {
    std::swap(balls_.front(), balls_.back());
    std::swap(cages_.front(), cages_.back());
  }
  if (!balls_[1].move_on_from(balls_.front(), curves)) {
    balls_.front().move_to(curves, 0);
    take(0);
  }
  if constexpr (requires { hierarchy_.bases(); }) {
    const auto bases = hierarchy_.bases();
    if (keep_bases_) start_bases_.assign(bases.begin(), bases.end());
  }
  for (int k = 1; k <= degree(); ++k) {
    if (k > 1) balls_[static_cast<std::size_t>(k)].move_to(curves, k);
    take(k);
  }
  moved_ = true;
}

template class ChordCages<StaticWrappedHierarchy<2>>;
template class ChordCages<StaticWrappedHierarchy<3>>;
template class ChordCages<LayeredHierarchy<2>>;
template class ChordCages<LayeredHierarchy<3>>;

}  // namespace kds
