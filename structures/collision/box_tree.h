#pragma once
// Boxes of a scene at one time: the bounding volumes of BoxHierarchy (axis-aligned boxes or k-DOPs) in
// doubles, built statically. Beads are nodes too. Each slab is rounded outwards, so it holds its balls.

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "certificates/types/reaches_further.h"
#include "structures/necklace/balls.h"
#include "structures/necklace/necklace_tree.h"

namespace kds {

struct TreeBox {
  std::uint32_t left, right;  ///< children; a bead names itself
  BeadId first, last;

  [[nodiscard]] bool is_bead() const { return first == last; }
};

template <int Dimension>
class BoxTree {
 public:
  /// `directions`: one of box_direction_counts (box_hierarchy.h). Throws std::invalid_argument for other
  /// numbers.
  BoxTree(std::span<const BeadRange> necklaces, int directions);

  /// Builds the slabs of all nodes from scratch, in time linear in nodes times directions. `balls` are the
  /// beads of the necklaces. If the slab of a ball is beyond the range of doubles, the slab is unbounded.
  void build(const Balls<Dimension>& balls);

  /// Returns the nodes of the hierarchy, then all beads, in their order.
  [[nodiscard]] std::span<const TreeBox> nodes() const { return nodes_; }
  [[nodiscard]] std::span<const SlabDirection> directions() const { return directions_; }

  /// Points x of the slab of direction d have low <= d.x <= high.
  struct Slab {
    double low, high;
  };
  /// Returns the slabs of a node, one for each direction.
  [[nodiscard]] std::span<const Slab> slabs(std::uint32_t node) const {
    return std::span(slabs_).subspan(node * directions_.size(), directions_.size());
  }

 private:
  std::vector<SlabDirection> directions_;
  std::vector<TreeBox> nodes_;
  std::vector<Slab> slabs_;  // of node i at i * directions_.size()
};

extern template class BoxTree<2>;
extern template class BoxTree<3>;

}  // namespace kds
