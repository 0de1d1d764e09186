#pragma once
// Kinetic wrapped hierarchy: the bases at the start of a step, and what a query asks for.

#include "structures/wrapped_hierarchy.h"

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
}

template <Motion M, Kernel K, Radii radii>
void WrappedHierarchy<M, K, radii>::start_step() {
  if (query_) ask_query();
  for (Node& node : nodes_) {
    node.held = none;
    node.never_failing = 0;
  }
  held_.clear();
  free_.clear();
  if constexpr (prunes) {
    paths_.set(motion_);
    find_chords();
  }
  std::optional<Balls> balls;
  per_bead_.assign(motion_.bead_count(), 0);
  for (NodeId id = 0; id < nodes_.size(); ++id) {
    if (!keeps(id)) continue;
    const Basis before = nodes_[id].basis;
    bool proper = radii == Radii::equal;
    if constexpr (prunes) {
      if (!is_lone_pair(id)) {
        chord_ = chords_[id];
        chord_basis_ = before;
        chord_from_ = 0;
        proper |= chord_.proved && chord_.stays == all_of(before);
      }
    }
    if (!proper) {
      // Balls that are not independent need not have a sphere: then the basis is found anew.
      if (!balls) balls = balls_at_start();
      if (!is_certainly_proper(*balls, before)) static_cast<void>(repair(id, no_bead));
    }
    guard_node(id, before);
    for (const BeadId b : named_) ++per_bead_[b];
  }
  const auto most = std::max_element(per_bead_.begin(), per_bead_.end());
  auto& per_bead_max = statistics.certificates.per_bead_max;
  if (most != per_bead_.end()) per_bead_max = std::max(per_bead_max, *most);
}

}  // namespace kds
