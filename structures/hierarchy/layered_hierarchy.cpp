#include "structures/hierarchy/layered_hierarchy.h"

#include <algorithm>
#include <cmath>

#include "motions/base/floating_point_guard.h"
#include "structures/enclosing_sphere/rounded_up.h"
#include "structures/hierarchy/parallel_passes.h"

namespace kds {

namespace {

// The bound. With u = 2^-53, `distance` errs by less than 4u of itself, where its square neither over- nor
// underflows. One sphere lies in the other only if that is true in spite of it. Where it all but does the
// centre is its own, and the radius no less. Else the centre, each of its
// coordinates rounded once or twice, is where it should be up to 6u of the distance and u of itself, and the
// radius, rounded four times, is larger than all that needs by 2^-49 of itself and 2^-51 of the coordinates.
template <int Dimension>
Cage<Dimension> around(const Cage<Dimension>& a, const Cage<Dimension>& b) {
  const Point<Dimension> d = detail::minus(b.center, a.center);
  const double square = detail::dot(d, d);
  const bool sized = square >= 0x1p-900 && square <= 0x1p900;
  const double distance = sized ? std::sqrt(square) : distance_rounded_up<Dimension>(a.center, b.center);
  const double wider = b.radius - a.radius;
  if (distance * (1 + 0x1p-48) <= std::abs(wider)) return wider > 0 ? b : a;
  if (!(std::abs(wider) >= 0)) return a;  // both radii have overflowed
  // On the line of centres: both far ends on the sphere.
  const double share = std::clamp(0.5 * (1 + wider / distance), 0.0, 1.0);
  Cage<Dimension> cage;
  double size = 0;
  for (std::size_t axis = 0; axis < Dimension; ++axis) {
    cage.center[axis] = a.center[axis] + share * d[axis];
    size += std::abs(cage.center[axis]);
  }
  const double reach = std::max(0.5 * (distance + (a.radius + b.radius)), std::max(a.radius, b.radius));
  cage.radius = reach * (1 + 0x1p-49) + 0x1p-51 * size;
  if (sized) return cage;
  for (std::size_t axis = 0; axis < Dimension; ++axis)
    cage.center[axis] = (1 - share) * a.center[axis] + share * b.center[axis];
  cage.radius = std::max(reach_rounded_up<Dimension>(cage.center, a.center, a.radius),
                         reach_rounded_up<Dimension>(cage.center, b.center, b.radius));
  return cage;
}

struct Nothing {
  Nothing& operator+=(const Nothing&) { return *this; }
};

}  // namespace

template <int Dimension>
LayeredHierarchy<Dimension>::LayeredHierarchy(std::span<const BeadRange> necklaces)
    : tree_(necklaces), order_(tree_), cages_(tree_.node_count()) {}

template <int Dimension>
void LayeredHierarchy<Dimension>::build(const Balls<Dimension>& balls, Threads threads) {
  const FloatingPointGuard to_nearest;
  const auto bead = [&balls](BeadId b) {
    return Cage<Dimension>{detail::center_of(balls, b), balls.radii()[b]};
  };
  over_runs<Nothing>(order_, threads, [&](std::size_t run) {
    for (const BottomUpOrder::Group& group : order_.groups(order_.runs()[run])) {
      for (const NodeId node : order_.nodes(group)) {
        const NodeId left = tree_.left(node), right = tree_.right(node);
        const BeadRange& range = tree_.range(node);
        cages_[node] = around(left == NecklaceTree::leaf ? bead(range.first) : cages_[left],
                              right == NecklaceTree::leaf ? bead(range.last) : cages_[right]);
      }
    }
    return Nothing{};
  });
}

template class LayeredHierarchy<2>;
template class LayeredHierarchy<3>;

}  // namespace kds
