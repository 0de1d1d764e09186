#pragma once
// Wrapped hierarchy of a scene at one time, and from one sampled time to the next: at every internal node of
// the balanced tree over a necklace the minimum enclosing sphere of its beads, by its basis (the paper's
// section 2). In the plane and in space; equal radii take the cheaper sphere of centres. Bases are exact:
// each encloses its beads and has none to spare, decided in double with proved errors or else in exact
// arithmetic; centres and radii are rounded, radii to 1e-12 of their size and better. Work: about n log n
// bead tests at worst to build or update, a few a node where beads clearly inside are settled by the cages of
// children.

#include <cstdint>
#include <span>
#include <vector>

#include "structures/balls.h"
#include "structures/basis.h"
#include "structures/cage.h"
#include "structures/necklace_tree.h"
#include "structures/subtrees.h"
#include "structures/threads.h"

namespace kds {

/// What was done to all nodes.
struct WrapCounts {
  std::uint64_t pivots = 0;   ///< in which one bead came into a basis
  std::uint64_t changed = 0;  ///< nodes with another basis than before
  std::uint64_t exact = 0;    ///< nodes that took exact arithmetic

  WrapCounts& operator+=(const WrapCounts& o) {
    pivots += o.pivots;
    changed += o.changed;
    exact += o.exact;
    return *this;
  }
};

template <int Dimension>
class StaticWrappedHierarchy {
 public:
  explicit StaticWrappedHierarchy(std::span<const BeadRange> necklaces);

  [[nodiscard]] const NecklaceTree& tree() const { return tree_; }
  [[nodiscard]] const Basis& basis(NodeId node) const { return bases_[node]; }
  /// Smallest sphere around the node's balls.
  [[nodiscard]] Sphere sphere(NodeId node) const { return sphere_of(cages_[node], wider_); }

  /// From scratch; each node starts with beads of its children's bases. The same bits whatever `threads`.
  WrapCounts build(const Balls<Dimension>& balls, Threads threads = Threads::one);
  /// From the bases of the time before: spheres of those, all beads verified, bases of which beads escaped or
  /// that have beads to spare repaired.
  WrapCounts update(const Balls<Dimension>& balls, Threads threads = Threads::one);

 private:
  template <class Form, bool from_children>
  WrapCounts wrap(const Balls<Dimension>& balls, Threads threads);

  NecklaceTree tree_;
  BottomUpOrder order_;
  std::vector<Basis> bases_;
  std::vector<Cage<Dimension>> cages_;
  std::vector<std::uint8_t>
      loose_;         // nodes whose beads may be out of the rounded cage by more than 2^-28 of it
  double wider_ = 0;  // cages are of centres if radii are equal: by how much spheres are wider
};

}  // namespace kds
