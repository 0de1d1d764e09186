#pragma once
// Layered hierarchy of a scene at one time: each internal node of the balanced tree over a necklace has the
// smallest sphere around the spheres of its two children (the paper's section 2.2). A build takes a few
// nanoseconds per node, four nodes at a time. Centres are rounded; they are centres of the smallest sphere up
// to some ulps.
//
// Each stored sphere, whose centre and radius are doubles, holds the stored spheres of its children, and so
// its beads, exactly. Radii are rounded up, at each level by less than 2^-48 of the radius and 2^-50 of the
// centre's coordinates.

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "structures/enclosing_sphere/cage.h"
#include "structures/enclosing_sphere/sphere_of_points.h"
#include "structures/hierarchy/bottom_up_order.h"
#include "structures/hierarchy/static_wrapped_hierarchy.h"
#include "structures/necklace/balls.h"
#include "structures/necklace/necklace_tree.h"

namespace kds {

template <int Dimension>
class LayeredHierarchy {
 public:
  static constexpr int dimension = Dimension;
  using BallsAt = BallRows<Dimension>;

  explicit LayeredHierarchy(std::span<const BeadRange> necklaces);

  [[nodiscard]] const NecklaceTree& tree() const { return tree_; }
  [[nodiscard]] Sphere sphere(NodeId node) const { return sphere_of(cages_[node], 0); }
  /// Moves the cages out in exchange for the memory of `others`. The next build computes new ones.
  void exchange_cages(std::vector<Cage<Dimension>>& others) {
    others.resize(cages_.size());
    cages_.swap(others);
  }

  void build(const BallRows<Dimension>& balls);

 private:
  /// Nodes and their children in groups of four. A group with fewer nodes repeats the last one.
  class Merges {
   public:
    struct Four {
      FourIndices node, left, right;
    };
    void append(NodeId node, std::uint32_t left, std::uint32_t right);
    [[nodiscard]] std::span<const Four> fours() const { return fours_; }

   private:
    std::vector<Four> fours_;
    std::size_t count_ = 0;
  };
  /// Nodes of one height: over two beads, over a node and a bead, over two nodes.
  struct Height {
    Merges of_beads, of_both, of_nodes;
  };

  NecklaceTree tree_;
  BottomUpOrder order_;
  std::vector<Height> heights_;  // for each group of the order
  std::vector<Cage<Dimension>> cages_;
};

/// Compares the wrapped hierarchy with the layered one: rho = wrapped radius / layered radius at a node, at
/// most 1. Computes its mean and minimum over all internal nodes (Table 1 of Agarwal et al.).
struct Tightness {
  double average = 1, least = 1;
};

/// Both hierarchies must be built over the same necklaces and balls. Nodes of radius 0 count as 1.
template <int Dimension>
[[nodiscard]] Tightness tightness_of(const StaticWrappedHierarchy<Dimension>& wrapped,
                                     const LayeredHierarchy<Dimension>& layered) {
  const std::size_t nodes = wrapped.tree().node_count();
  if (nodes == 0) return {};
  Tightness ratios{0, 1};
  for (NodeId node = 0; node < nodes; ++node) {
    const double outer = layered.sphere(node).radius;
    const double rho = outer > 0 ? wrapped.sphere(node).radius / outer : 1;
    ratios.average += rho / static_cast<double>(nodes);
    ratios.least = std::min(ratios.least, rho);
  }
  return ratios;
}

}  // namespace kds
