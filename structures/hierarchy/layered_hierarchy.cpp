#include "structures/hierarchy/layered_hierarchy.h"

#include <cmath>

#include "motions/base/floating_point_guard.h"
#include "structures/hierarchy/parallel_passes.h"

namespace kds {

namespace {

template <int Dimension>
Cage<Dimension> around(const Cage<Dimension>& a, const Cage<Dimension>& b) {
  Point<Dimension> d = detail::minus(b.center, a.center);
  const double distance = std::sqrt(detail::dot(d, d));
  const double wider = b.radius - a.radius;
  if (distance <= std::abs(wider)) return wider > 0 ? b : a;
  // On the line of centres: both far ends on the sphere.
  const double share = 0.5 * (1 + wider / distance);
  Cage<Dimension> cage;
  for (std::size_t axis = 0; axis < Dimension; ++axis) cage.center[axis] = a.center[axis] + share * d[axis];
  cage.radius = 0.5 * (distance + (a.radius + b.radius));
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
