#include "structures/hierarchy/static_wrapped_hierarchy.h"

#include <algorithm>

#include "motions/base/floating_point_scope.h"
#include "motions/base/interruption.h"
#include "structures/hierarchy/hierarchy_passes.h"

namespace kds {

namespace {

using detail::most_in_block;
using detail::nodes_at_a_time;
using detail::NodeWrapper;
using detail::Start;
using detail::trusted_cage;

// Groups of one run are consecutive. Returns `together` groups from `first` on as one list of nodes.
std::span<const NodeId> nodes_of(const BottomUpOrder& order, std::span<const BottomUpOrder::Group> groups,
                                 std::size_t first, std::size_t together) {
  return order.nodes({groups[first].first, groups[first + together - 1].end});
}

template <class Form>
void wrap_groups(NodeWrapper<Form>& wrapper, const BottomUpOrder& order,
                 std::span<const BottomUpOrder::Group> groups, Start start) {
  const auto beads = [&](std::size_t g) {
    const BeadRange range = wrapper.tree.range(order.nodes(groups[g])[0]);
    return range.last - range.first + 1;
  };
  for (std::size_t g = 0, together = 1; g < groups.size(); g += together) {
    together = 1;
    if (beads(g) == 2) {
      const auto pairs = order.nodes(groups[g]);
      wrapper.wrap_pairs(pairs.data(), pairs.size(), start);
      continue;
    }
    // With old bases, a node does not depend on the nodes below, so groups of several heights are merged.
    // Bead counts of nodes of one height differ by less than a factor of two.
    if (start == Start::old_bases && 2 * beads(g) <= most_in_block)
      while (g + together < groups.size() && 2 * beads(g + together) <= most_in_block) ++together;
    const auto nodes = nodes_of(order, groups, g, together);
    for (std::size_t i = 0; i < nodes.size(); i += nodes_at_a_time) {
      InterruptionCheck::ask();
      wrapper.wrap(nodes.data() + i, std::min(nodes_at_a_time, nodes.size() - i), start);
    }
  }
}

template <class Form>
void trust_groups(NodeWrapper<Form>& wrapper, const BottomUpOrder& order,
                  std::span<const BottomUpOrder::Group> groups) {
  if (groups.empty()) return;
  const auto lowest = order.nodes(groups[0]);
  const BeadRange range = wrapper.tree.range(lowest[0]);
  const std::size_t pairs = range.last - range.first == 1 ? 1 : 0;
  if (pairs == 1) wrapper.trust_pairs(lowest.data(), lowest.size());
  if (groups.size() == pairs) return;
  const auto nodes = nodes_of(order, groups, pairs, groups.size() - pairs);
  for (std::size_t i = 0; i < nodes.size(); i += nodes_at_a_time)
    wrapper.trust(nodes.data() + i, std::min(nodes_at_a_time, nodes.size() - i));
}

template <class Form>
void cascade_groups(NodeWrapper<Form>& wrapper, const BottomUpOrder& order,
                    std::span<const BottomUpOrder::Group> groups, std::vector<std::uint32_t>& frontiers) {
  std::vector<std::uint32_t> next;
  next.reserve(frontiers.size());
  for (const BottomUpOrder::Group& group : groups) {
    const std::span<const NodeId> nodes = order.nodes(group);
    const BeadRange range = wrapper.tree.range(nodes[0]);
    if (range.last - range.first == 1) {  // nothing to test
      wrapper.wrap_pairs(nodes.data(), nodes.size(), Start::old_bases);
      wrapper.counts.frontier += 2 * nodes.size();
      continue;
    }
    for (const NodeId node : nodes) wrapper.wrap_by_cascade(node, frontiers, next);
  }
  frontiers.swap(next);
}

}  // namespace

template <int Dimension>
StaticWrappedHierarchy<Dimension>::StaticWrappedHierarchy(std::span<const BeadRange> necklaces)
    : tree_(necklaces), order_(tree_) {}

template <int Dimension>
template <class Form>
WrapCounts StaticWrappedHierarchy<Dimension>::wrap(const Balls<Dimension>& balls, bool from_children,
                                                   Update how) {
  const auto runs = order_.runs();
  WrapCounts counts;
  for (std::size_t run = 0; run < runs.size(); ++run) {
    const auto groups = order_.groups(runs[run]);
    NodeWrapper<Form> wrapper{tree_, balls, bases_.data(), cages_.data(), loose_.data(), how, frontiers_};
    if (from_children) {
      wrap_groups<Form>(wrapper, order_, groups, Start::children);
    } else if (how == Update::trust) {
      trust_groups<Form>(wrapper, order_, groups);
    } else if (how == Update::cascade) {
      cascade_groups<Form>(wrapper, order_, groups, frontiers_.of_run[run]);
    } else {
      wrap_groups<Form>(wrapper, order_, groups, Start::old_bases);
    }
    counts += wrapper.counts;
  }
  return counts;
}

template <int Dimension>
WrapCounts StaticWrappedHierarchy<Dimension>::build(const Balls<Dimension>& balls) {
  const FloatingPointScope to_nearest;
  bases_.resize(tree_.node_count());
  cages_.resize(tree_.node_count());
  loose_.resize(tree_.node_count());
  frontiers_.of_run.assign(order_.runs().size(), {});
  frontiers_.of_node.assign(tree_.node_count(), {});
  wider_ = balls.equal_radii() && balls.size() > 0 ? balls.radius(0) : 0;
  lazy_ = nullptr;
  return balls.equal_radii() ? wrap<PointForm<Dimension>>(balls, true, Update::blocks)
                             : wrap<BallForm<Dimension>>(balls, true, Update::blocks);
}

template <int Dimension>
WrapCounts StaticWrappedHierarchy<Dimension>::update(const Balls<Dimension>& balls, Update how) {
  const FloatingPointScope to_nearest;
  if (bases_.size() != tree_.node_count()) return build(balls);
  lazy_ = how == Update::lazy ? &balls : nullptr;
  wider_ = balls.equal_radii() && balls.size() > 0 ? balls.radius(0) : 0;
  if (lazy_ != nullptr) return {};
  return balls.equal_radii() ? wrap<PointForm<Dimension>>(balls, false, how)
                             : wrap<BallForm<Dimension>>(balls, false, how);
}

template <int Dimension>
Sphere StaticWrappedHierarchy<Dimension>::sphere(NodeId node) const {
  const FloatingPointScope to_nearest;
  if (lazy_ == nullptr) return sphere_of(cages_[node], wider_);
  return sphere_of(lazy_->equal_radii() ? trusted_cage<PointForm<Dimension>>(*lazy_, bases_[node])
                                        : trusted_cage<BallForm<Dimension>>(*lazy_, bases_[node]),
                   wider_);
}

template class StaticWrappedHierarchy<2>;
template class StaticWrappedHierarchy<3>;

}  // namespace kds
