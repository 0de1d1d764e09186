#include "structures/collision/box_tree.h"

#include <algorithm>
#include <cmath>

#include "motions/base/floating_point_scope.h"
#include "structures/hierarchy/box_hierarchy.h"

namespace kds {

namespace {

// Returns the slab of a ball along a direction. At most seven roundings enter each end, each by at most 2^-53
// of `size + reach`.
template <int Dimension>
typename BoxTree<Dimension>::Slab slab_of(const Balls<Dimension>& balls, BeadId bead,
                                          const SlabDirection& direction) {
  double along = 0, size = 0;
  for (std::size_t axis = 0; axis < Dimension; ++axis) {
    const double x = direction.steps[axis] * balls.coordinate(bead, axis);
    along += x;
    size += std::abs(x);
  }
  const double reach = balls.radius(bead) * std::sqrt(static_cast<double>(direction.square()));
  const double error = 0x1p-49 * (size + reach) + 0x1p-1060;
  if (!std::isfinite(size + reach)) return {-HUGE_VAL, HUGE_VAL};  // sums overflow
  return {along - reach - error, along + reach + error};
}

}  // namespace

template <int Dimension>
BoxTree<Dimension>::BoxTree(std::span<const BeadRange> necklaces, int directions)
    : directions_(box_directions<Dimension>(directions)) {
  const NecklaceTree tree(necklaces);
  const auto internal = static_cast<std::uint32_t>(tree.node_count());
  const auto child = [internal](NodeId node, BeadId leaf) {
    return node == NecklaceTree::leaf ? internal + leaf : node;
  };
  for (NodeId node = 0; node < internal; ++node) {
    const auto [first, last] = tree.range(node);
    nodes_.push_back({child(tree.left(node), first), child(tree.right(node), last), first, last});
  }
  const std::uint32_t beads = necklaces.empty() ? 0 : necklaces.back().last + 1;
  for (BeadId bead = 0; bead < beads; ++bead)
    nodes_.push_back({internal + bead, internal + bead, bead, bead});
  slabs_.resize(nodes_.size() * directions_.size());
}

template <int Dimension>
void BoxTree<Dimension>::build(const Balls<Dimension>& balls) {
  const FloatingPointScope to_nearest;
  const std::size_t count = directions_.size();
  for (std::size_t node = nodes_.size(); node-- > 0;) {  // children before their parents
    const TreeBox& box = nodes_[node];
    Slab* const slabs = &slabs_[node * count];
    if (box.is_bead()) {
      for (std::size_t k = 0; k < count; ++k) slabs[k] = slab_of(balls, box.first, directions_[k]);
      continue;
    }
    const Slab *const left = &slabs_[box.left * count], *const right = &slabs_[box.right * count];
    for (std::size_t k = 0; k < count; ++k)
      slabs[k] = {std::min(left[k].low, right[k].low), std::max(left[k].high, right[k].high)};
  }
}

template class BoxTree<2>;
template class BoxTree<3>;

}  // namespace kds
