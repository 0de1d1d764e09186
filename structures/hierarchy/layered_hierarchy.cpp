#include "structures/hierarchy/layered_hierarchy.h"

#include <array>

#include "motions/base/floating_point_guard.h"
#include "motions/numbers/long_lanes.h"
#include "structures/hierarchy/parallel_passes.h"
#include "structures/hierarchy/sphere_of_two.h"

namespace kds {

namespace {

struct Nothing {
  Nothing& operator+=(const Nothing&) { return *this; }
};

// Computes the spheres of nodes of one height.
template <bool equal, int Dimension, class Four>
void wrap(std::span<const Four> merges, const Cage<Dimension>* left_spheres,
          const Cage<Dimension>* right_spheres, Cage<Dimension>* cages) {
  using Balls = FourBalls<Dimension>;
  Lanes::Mask usual = ~Lanes::Mask{};
  for (const Four& four : merges) {
    Balls spheres;
    usual &= spheres_of_two<equal>(Balls(left_spheres, four.left), Balls(right_spheres, four.right), spheres);
    spheres.store(cages, four.node);
  }
  if (Lanes::all(usual)) return;
  for (const Four& four : merges) {
    Balls spheres;
    usual = spheres_of_two<equal>(Balls(left_spheres, four.left), Balls(right_spheres, four.right), spheres);
    for (std::size_t lane = 0; lane < Lanes::width; ++lane)
      if (usual[lane] == 0)
        cages[four.node[lane]] =
            sphere_of_two(left_spheres[four.left[lane]], right_spheres[four.right[lane]]);
  }
}

}  // namespace

template <int Dimension>
LayeredHierarchy<Dimension>::LayeredHierarchy(std::span<const BeadRange> necklaces)
    : tree_(necklaces), order_(tree_), cages_(tree_.node_count()) {
  for (const BottomUpOrder::Run& run : order_.runs()) {
    for (const BottomUpOrder::Group& group : order_.groups(run)) {
      Height& height = heights_.emplace_back();
      for (const NodeId node : order_.nodes(group)) {
        const NodeId left = tree_.left(node), right = tree_.right(node);
        const BeadRange& range = tree_.range(node);
        if (left == NecklaceTree::leaf) {  // the left half is the larger, so both are single beads
          height.of_beads.append(node, range.first, range.last);
        } else if (right == NecklaceTree::leaf) {
          height.of_both.append(node, left, range.last);
        } else {
          height.of_nodes.append(node, left, right);
        }
      }
    }
  }
}

template <int Dimension>
void LayeredHierarchy<Dimension>::Merges::append(NodeId node, std::uint32_t left, std::uint32_t right) {
  if (count_ % Lanes::width == 0) fours_.emplace_back();
  for (std::size_t lane = count_++ % Lanes::width; lane < Lanes::width; ++lane) {
    fours_.back().node[lane] = node;
    fours_.back().left[lane] = left;
    fours_.back().right[lane] = right;
  }
}

template <int Dimension>
void LayeredHierarchy<Dimension>::build(const BallRows<Dimension>& balls, Threads threads) {
  const FloatingPointGuard to_nearest;
  const BallRow<Dimension>* const beads = balls.rows();
  Cage<Dimension>* const cages = cages_.data();
  using Four = typename Merges::Four;
  constexpr auto wrap_in_lanes = in_long_lanes<&wrap<false, Dimension, Four>>;
  const auto wrap_beads = balls.equal_radii() ? in_long_lanes<&wrap<true, Dimension, Four>> : wrap_in_lanes;
  over_runs<Nothing>(order_, threads, [&](std::size_t run) {
    for (std::uint32_t group = order_.runs()[run].first; group < order_.runs()[run].end; ++group) {
      const Height& height = heights_[group];
      wrap_beads(height.of_beads.fours(), beads, beads, cages);
      wrap_in_lanes(height.of_both.fours(), cages, beads, cages);
      wrap_in_lanes(height.of_nodes.fours(), cages, cages, cages);
    }
    return Nothing{};
  });
}

template class LayeredHierarchy<2>;
template class LayeredHierarchy<3>;

}  // namespace kds
