#pragma once
// Balanced binary trees over the bead sequences of a scene, one tree per necklace, in flat arrays. The
// wrapped hierarchy attaches its spheres to their nodes. Only internal nodes are stored, children after their
// parent. A node covers beads first..last, at least two, and its children cover the halves first..middle and
// middle+1..last.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "motions/base/bead.h"

namespace kds {

struct Sphere;

using NodeId = std::uint32_t;

class NecklaceTree {
 public:
  static constexpr NodeId leaf = 0xffffffffU;

  explicit NecklaceTree(std::span<const BeadRange> necklaces) {
    for (const BeadRange& necklace : necklaces) {
      if (necklace.first < necklace.last) add(necklace);
    }
  }

  [[nodiscard]] std::size_t node_count() const { return ranges_.size(); }
  [[nodiscard]] const BeadRange& range(NodeId node) const { return ranges_[node]; }
  [[nodiscard]] std::span<const BeadRange> ranges() const { return ranges_; }
  /// Returns a child, or `leaf` if that half is a single bead.
  [[nodiscard]] NodeId left(NodeId node) const { return left_[node]; }
  [[nodiscard]] NodeId right(NodeId node) const { return right_[node]; }

  [[nodiscard]] std::optional<NodeId> find(const BeadRange& range) const {
    for (NodeId node = 0; node < ranges_.size();) {
      if (ranges_[node] == range) return node;
      if (ranges_[node].last < range.first) {  // the range lies in a later necklace: skip this tree
        node += ranges_[node].last - ranges_[node].first;
        continue;
      }
      const NodeId child = range.last <= middle(ranges_[node]) ? left_[node] : right_[node];
      if (child == leaf) break;
      node = child;
    }
    return std::nullopt;
  }

 private:
  static BeadId middle(const BeadRange& range) { return range.first + (range.last - range.first) / 2; }

  NodeId add(const BeadRange& range) {
    if (range.first == range.last) return leaf;
    const auto node = static_cast<NodeId>(ranges_.size());
    ranges_.push_back(range);
    left_.push_back(leaf);
    right_.push_back(leaf);
    const BeadId m = middle(range);
    const NodeId l = add({range.first, m});
    const NodeId r = add({m + 1, range.last});
    left_[node] = l;
    right_[node] = r;
    return node;
  }

  std::vector<BeadRange> ranges_;
  std::vector<NodeId> left_, right_;
};

/// Selects the nodes of a hierarchy that a scene requires, by level and by beads. Selects all nodes by
/// default.
struct NodeSelection {
  std::uint32_t first_level = 0;  ///< roots are level 0
  std::uint32_t last_level = std::numeric_limits<std::uint32_t>::max();
  std::optional<BeadRange> beads;  ///< selects nodes whose beads all lie in this range

  [[nodiscard]] bool restricts() const {
    return first_level > 0 || last_level < std::numeric_limits<std::uint32_t>::max() || beads;
  }
};

[[nodiscard]] inline std::vector<std::uint8_t> select_nodes(const NecklaceTree& tree,
                                                            const NodeSelection& selection) {
  std::vector<std::uint32_t> level(tree.node_count(), 0);
  std::vector<std::uint8_t> selected(tree.node_count(), 0);
  for (NodeId node = 0; node < tree.node_count(); ++node) {  // visits children after their parents
    for (const NodeId child : {tree.left(node), tree.right(node)}) {
      if (child != NecklaceTree::leaf) level[child] = level[node] + 1;
    }
    const BeadRange& range = tree.range(node);
    const bool among =
        !selection.beads || (selection.beads->first <= range.first && range.last <= selection.beads->last);
    selected[node] = among && selection.first_level <= level[node] && level[node] <= selection.last_level;
  }
  return selected;
}

/// A callback that runs at the start of each step. The callback requests the spheres of the nodes it needs,
/// and these spheres are maintained during the step.
using NodeQuery = std::function<void(const std::function<Sphere(NodeId)>&)>;

}  // namespace kds
