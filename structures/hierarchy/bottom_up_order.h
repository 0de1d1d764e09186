#pragma once
// Bottom-up passes over the nodes of a scene's trees. Each pass handles many independent nodes of one height
// at a time, first those of small disjoint subtrees, whose beads stay in a fast cache, and then the nodes
// above them. A pass must compute a node only from itself and the nodes below.

#include <cstdint>
#include <span>
#include <vector>

#include "structures/necklace/necklace_tree.h"

namespace kds {

class BottomUpOrder {
 public:
  explicit BottomUpOrder(const NecklaceTree& tree);

  /// Nodes of one height, from subtrees whose groups are stored consecutively.
  struct Group {
    std::uint32_t first, end;  ///< indices in the order
  };
  struct Run {
    std::uint32_t first, end;  ///< indices of groups
  };

  [[nodiscard]] std::span<const NodeId> nodes(const Group& group) const {
    return {order_.data() + group.first, order_.data() + group.end};
  }
  [[nodiscard]] std::span<const Group> groups(const Run& run) const {
    return {groups_.data() + run.first, groups_.data() + run.end};
  }
  /// Each run holds one or several disjoint subtrees; the last run holds the nodes above all others.
  [[nodiscard]] std::span<const Run> runs() const { return runs_; }

 private:
  void add(std::span<const NodeId> nodes);

  std::vector<std::uint8_t> height_;
  std::vector<NodeId> order_;
  std::vector<Group> groups_;
  std::vector<Run> runs_;
};

}  // namespace kds
