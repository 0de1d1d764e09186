#pragma once
// Selects the nodes of a hierarchy that a scene requires: nodes of certain levels, nodes over certain beads,
// or nodes that a query visits.

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "structures/necklace/necklace_tree.h"

namespace kds {

struct Sphere;

/// Selects all nodes by default.
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
