#pragma once
// Bottom-up passes over the nodes of a scene's trees, many nodes of one height at a time, which do not depend
// on each other; with threads, disjoint subtrees at once and then what is above them. A pass must compute a
// node from itself and what is below it only: then the result is the same bit for bit.

#include <cstdint>
#include <span>
#include <vector>

#include "structures/necklace/necklace_tree.h"

namespace kds {

class BottomUpOrder {
 public:
  explicit BottomUpOrder(const NecklaceTree& tree);

  /// Nodes of one height, of subtrees whose groups stand one after the other.
  struct Group {
    std::uint32_t first, end;  ///< places in the order
  };
  struct Run {
    std::uint32_t first, end;  ///< groups
  };

  [[nodiscard]] std::span<const NodeId> nodes(const Group& group) const {
    return {order_.data() + group.first, order_.data() + group.end};
  }
  [[nodiscard]] std::span<const Group> groups(const Run& run) const {
    return {groups_.data() + run.first, groups_.data() + run.end};
  }
  /// Disjoint subtrees, or several; the last run holds all that is above others.
  [[nodiscard]] std::span<const Run> runs() const { return runs_; }

 private:
  void add(std::span<const NodeId> nodes);

  std::vector<std::uint8_t> height_;
  std::vector<NodeId> order_;
  std::vector<Group> groups_;
  std::vector<Run> runs_;
};

}  // namespace kds
