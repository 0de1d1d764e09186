#pragma once
// Balanced binary trees over the bead sequences of a scene, one tree per necklace, in flat arrays. The
// wrapped hierarchy attaches its spheres to their nodes. Only internal nodes are stored, children after their
// parent. A node covers beads first..last, at least two, and its children cover the halves first..middle and
// middle+1..last.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "motions/base/bead_range.h"

namespace kds {

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

}  // namespace kds
