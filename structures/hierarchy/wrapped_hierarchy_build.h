#pragma once
// Kinetic wrapped hierarchy: the bases at the start of a run, and what a query asks for.

#include "structures/hierarchy/wrapped_hierarchy.h"

namespace kds {

template <Motion M, Kernel K, Radii radii>
void WrappedHierarchy<M, K, radii>::build_node(NodeId id, const Balls& balls) {
  const BeadRange range = tree_.range(id);
  std::vector<BeadId> guess{range.first, range.last};
  for (const NodeId child : {tree_.left(id), tree_.right(id)}) {
    if (child != NecklaceTree::leaf)
      guess.insert(guess.end(), nodes_[child].basis.begin(), nodes_[child].basis.end());
  }
  nodes_[id].basis = smallest_sphere(balls, range.first, range.last, guess).basis;
  resting_.forget(id);
}

template <Motion M, Kernel K, Radii radii>
void WrappedHierarchy<M, K, radii>::build() {
  if (query_) kept_.assign(nodes_.size(), 0);  // it has not asked yet
  const Balls balls = balls_at_start();
  auto signs = signs_just_after();
  for (auto id = static_cast<NodeId>(nodes_.size()); id-- > 0;) {  // children first
    if (!keeps(id)) continue;
    build_node(id, balls);
    // Put right for the moment after the start: beads on the sphere may leave it.
    const BeadRange range = tree_.range(id);
    bool settled = false;
    for (int i = 0; !settled && (i < most_repairs || !std::same_as<K, Fast>); ++i) {
      settled = true;
      const int orientation = orientation_of(nodes_[id].basis, signs);
      for (BeadId b = range.first; b <= range.last; ++b) {
        if (nodes_[id].basis.contains(b) || is_inside(nodes_[id].basis, b, orientation, signs)) continue;
        settled = !repair(id, b);
        break;
      }
    }
  }
}

template <Motion M, Kernel K, Radii radii>
void WrappedHierarchy<M, K, radii>::ask_query() {
  const Balls balls = balls_at_start();
  const std::vector<std::uint8_t> known = std::exchange(kept_, std::vector<std::uint8_t>(nodes_.size(), 0));
  query_([&](NodeId id) {
    if (id >= nodes_.size()) throw std::invalid_argument("the hierarchy has no such node");
    if (kept_[id] == 0 && known[id] == 0) build_node(id, balls);
    kept_[id] = 1;
    return exact_sphere_of(nodes_[id].basis, balls);
  });
  sort_kept_nodes();
}

}  // namespace kds
