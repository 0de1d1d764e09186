#pragma once
// Boxes of a scene at one time, in the form that a search over pairs of nodes needs: the bounding volumes of
// BoxHierarchy (axis-aligned boxes or k-DOPs) in doubles. Beads are nodes too. Each slab is rounded outwards,
// so it holds its balls, and disjoint slabs prove balls disjoint.

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
  [[nodiscard]] BeadId bead_count() const { return last - first + 1; }
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
  /// Returns the root of each necklace, as an index of nodes().
  [[nodiscard]] std::span<const std::uint32_t> roots() const { return roots_; }
  [[nodiscard]] std::span<const SlabDirection> directions() const { return directions_; }

  /// Points x of the slab of direction d have low <= d.x <= high.
  struct Slab {
    double low, high;
  };
  /// Returns the slabs of a node, one for each direction.
  [[nodiscard]] std::span<const Slab> slabs(std::uint32_t node) const {
    return std::span(slabs_).subspan(node * directions_.size(), directions_.size());
  }
  /// Returns whether some direction proves that the balls of the two nodes are farther apart than `distance`,
  /// which is not negative.
  [[nodiscard]] bool are_apart(std::uint32_t a, std::uint32_t b, double distance = 0) const {
    const std::span<const Slab> of_a = slabs(a), of_b = slabs(b);
    for (std::size_t k = 0; k < of_a.size(); ++k) {
      const double gap = std::max(of_b[k].low - of_a[k].high, of_a[k].low - of_b[k].high);
      // At distance 0 the sign of the gap is exact. Otherwise the gap and the product are rounded once each,
      // by less than the 2^-49 of lengths_.
      if (gap > distance * lengths_[k]) return true;
    }
    return false;
  }

 private:
  std::vector<SlabDirection> directions_;
  std::vector<double> lengths_;  // |d| (1 + 2^-49) of each direction d
  std::uint32_t internal_ = 0;   // number of internal nodes
  std::vector<TreeBox> nodes_;
  std::vector<std::uint32_t> roots_;
  std::vector<Slab> slabs_;  // of node i at i * directions_.size()
};

extern template class BoxTree<2>;
extern template class BoxTree<3>;

}  // namespace kds
