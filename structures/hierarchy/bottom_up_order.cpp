#include "structures/hierarchy/bottom_up_order.h"

#include <algorithm>

namespace kds {

namespace {

// Enough nodes to fill the lanes; the beads of such a subtree stay in a fast cache.
constexpr NodeId most_nodes_in_run = 1024;

}  // namespace

BottomUpOrder::BottomUpOrder(const NecklaceTree& tree) : height_(tree.node_count()) {
  const auto count = static_cast<NodeId>(tree.node_count());
  const auto height = [&](NodeId child) { return child == NecklaceTree::leaf ? 0 : height_[child]; };
  for (NodeId node = count; node-- > 0;)
    height_[node] =
        static_cast<std::uint8_t>(1 + std::max(height(tree.left(node)), height(tree.right(node))));
  std::vector<NodeId> above, run;
  for (NodeId node = 0; node < count;) {
    const NodeId nodes = tree.range(node).last - tree.range(node).first;
    if (nodes > most_nodes_in_run) {
      above.push_back(node++);
      continue;
    }
    if (!run.empty() && run.size() + nodes > most_nodes_in_run) {
      add(run);
      run.clear();
    }
    for (NodeId i = 0; i < nodes; ++i) run.push_back(node++);
  }
  add(run);
  add(above);
}

void BottomUpOrder::add(std::span<const NodeId> nodes) {
  const auto first = order_.size();
  order_.insert(order_.end(), nodes.begin(), nodes.end());
  std::stable_sort(order_.begin() + static_cast<std::ptrdiff_t>(first), order_.end(),
                   [this](NodeId a, NodeId b) { return height_[a] < height_[b]; });
  Run run{static_cast<std::uint32_t>(groups_.size()), 0};
  for (std::size_t i = first; i < order_.size(); ++i) {
    if (i == first || height_[order_[i]] != height_[order_[i - 1]])
      groups_.push_back({static_cast<std::uint32_t>(i), 0});
    groups_.back().end = static_cast<std::uint32_t>(i + 1);
  }
  run.end = static_cast<std::uint32_t>(groups_.size());
  runs_.push_back(run);
}

}  // namespace kds
