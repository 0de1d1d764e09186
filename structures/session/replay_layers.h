#pragma once
// Layers of a structure, as replays show them. A layer is a set of elements, for example all edges of a
// diagram. An element is a few ids, for example the two beads of an edge. Events remove and add elements.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "kds/kinetic_structure.h"
#include "motions/base/bead.h"
#include "structures/necklace/necklace_tree.h"

namespace kds {

/// The ids of an element. Unused entries hold no_bead.
using ReplayElement = std::array<BeadId, 5>;

[[nodiscard]] inline ReplayElement replay_element(std::initializer_list<BeadId> ids) {
  ReplayElement element;
  element.fill(no_bead);
  std::copy(ids.begin(), ids.end(), element.begin());
  return element;
}

struct ReplayLayer {
  std::string_view name;  ///< in static storage
  std::size_t arity = 1;  ///< number of ids of an element, at most 5
  /// The first ids of an element are its place. A layer has at most one element at a
  /// place, so an element that is added there replaces the one before.
  std::size_t place_ids = 1;
};

/// One change of a layer. A removal names the place alone.
struct ReplayEdit {
  std::size_t layer = 0;
  bool adds = true;
  ReplayElement element{};
};

/// A node of a hierarchy, whose element in the layer `cages` names it by its index.
struct ReplayNode {
  static constexpr std::uint32_t no_parent = std::numeric_limits<std::uint32_t>::max();

  BeadRange beads;
  std::uint32_t level = 0;  ///< 0 at the roots
  std::uint32_t parent = no_parent;
};

/// Returns the nodes of the tree in its order.
[[nodiscard]] inline std::vector<ReplayNode> replay_nodes(const NecklaceTree& tree) {
  std::vector<ReplayNode> nodes(tree.node_count());
  for (NodeId node = 0; node < nodes.size(); ++node) {  // visits children after their parents
    nodes[node].beads = tree.range(node);
    for (const NodeId child : {tree.left(node), tree.right(node)})
      if (child != NecklaceTree::leaf) {
        nodes[child].level = nodes[node].level + 1;
        nodes[child].parent = node;
      }
  }
  return nodes;
}

/// The layers of a structure. Layers change at events. A rebuild at a frame, which the structure's statistics
/// count, changes layers too.
///
///   cages     node, then the beads of the node's basis; unused entries last
///   edges     the two beads of an edge, ascending
///   hidden    a bead without a cell in the power diagram
///   balls     a bead of the dual complex; links, triangles, tetrahedra: its simplices of two to four beads,
///             ascending
///   contacts  the two beads of a pair in contact, ascending
///   supports  node, side (low, high of the first direction, then of the next), the bead that holds the side
///   ends      end (low, high of the first axis, then of the next), the bead there
///   hull      a corner, then the next corner counterclockwise; the corner itself if it is alone
///   closest   the two beads of the closest pair, ascending
///   order     rank, then the bead of this rank
struct ReplayScheme {
  std::vector<ReplayLayer> layers;
  std::vector<ReplayNode> nodes;  ///< for `cages` and `supports`, and for spheres
  /// For a structure without events whose spheres follow curves between frames: the nodes that have spheres
  /// (RunningStructure::replay_spheres).
  std::vector<std::uint32_t> sphere_nodes{};
};

}  // namespace kds
