#pragma once
// Wrapped hierarchy of a scene at one time, updated from one sampled time to the next: each internal node of
// the balanced tree over a necklace has the minimum enclosing sphere of its beads, given by its basis
// (the paper's section 2). Works in the plane and in space; equal radii use the cheaper sphere of centres.
//
// Bases are exact: each encloses its beads without a superfluous bead, decided in double with proved errors
// or else in exact arithmetic. Centres and radii are rounded; the relative error of radii is at most 1e-12. A
// build or an update takes about n log n bead tests at worst, and only a few per node if the children's cages
// settle beads that are clearly inside.

#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "structures/enclosing_sphere/basis.h"
#include "structures/enclosing_sphere/cage.h"
#include "structures/hierarchy/bottom_up_order.h"
#include "structures/necklace/balls.h"
#include "structures/necklace/necklace_tree.h"

namespace kds {

/// Methods to bring a hierarchy to another time.
enum class Update : std::uint8_t {
  naive,    ///< tests every bead of every node
  cascade,  ///< tests cages first and beads only where cages are not inside; starts from the last frontier
  blocks,   ///< cascades in large nodes, tests small ones bead by bead, eight at a time: the fastest
  trust,    ///< computes spheres of the old bases without tests: beads may stick out
  lazy      ///< computes a sphere of an old basis only when it is asked for
};

/// Counts over all nodes.
struct WrapCounts {
  std::uint64_t pivots = 0;      ///< number of beads inserted into bases
  std::uint64_t changed = 0;     ///< nodes whose basis changed
  std::uint64_t exact = 0;       ///< nodes that needed exact arithmetic
  std::uint64_t bead_tests = 0;  ///< beads tested against a sphere; `cascade` leaves out basis beads
  std::uint64_t cage_tests = 0;  ///< cages tested against a sphere
  std::uint64_t frontier = 0;    ///< cages and beads in the frontiers of all nodes, by `cascade`

  WrapCounts& operator+=(const WrapCounts& o) {
    pivots += o.pivots;
    changed += o.changed;
    exact += o.exact;
    bead_tests += o.bead_tests;
    cage_tests += o.cage_tests;
    frontier += o.frontier;
    return *this;
  }
};

/// The frontier of each node: the nodes and beads at which its last cascade ended and the next one starts.
/// There is one list for each run of the order. In the lists, bead b has the number 2^31 + b.
struct Frontiers {
  static constexpr std::uint32_t bead = 0x80000000U;
  std::vector<std::vector<std::uint32_t>> of_run;
  std::vector<BottomUpOrder::Group> of_node;  ///< indices in the run's list; empty if unknown
};

template <int Dimension>
class StaticWrappedHierarchy {
 public:
  static constexpr int dimension = Dimension;
  using BallsAt = Balls<Dimension>;

  explicit StaticWrappedHierarchy(std::span<const BeadRange> necklaces);

  [[nodiscard]] const NecklaceTree& tree() const { return tree_; }
  /// After Update::trust or lazy, returns those of the last verified time.
  [[nodiscard]] const Basis& basis(NodeId node) const { return bases_[node]; }
  [[nodiscard]] std::span<const Basis> bases() const { return bases_; }
  /// Moves the cages out in exchange for the memory of `others`. The next build or update computes new ones;
  /// until then there are bases but no spheres. If radii are equal, cages enclose centres and spheres are
  /// wider by `wider_than_cages`.
  void exchange_cages(std::vector<Cage<Dimension>>& others) {
    others.resize(cages_.size());
    cages_.swap(others);
  }
  [[nodiscard]] double wider_than_cages() const { return wider_; }
  /// Visits nodes for whose cages doubles have not proved how far beads may be out, because exact arithmetic
  /// decided or the centre lost digits far from the origin.
  template <class Visit>
  void visit_loose(const Visit& visit) const {
    const std::uint8_t* const begin = loose_.data();
    for (std::size_t node = 0; node < loose_.size(); ++node) {
      const void* const next = std::memchr(begin + node, 1, loose_.size() - node);
      if (next == nullptr) return;
      node = static_cast<std::size_t>(static_cast<const std::uint8_t*>(next) - begin);
      visit(static_cast<NodeId>(node));
    }
  }
  /// Returns the smallest sphere around the node's balls; after Update::trust or lazy, around its basis'
  /// balls only.
  [[nodiscard]] Sphere sphere(NodeId node) const;

  /// Builds the hierarchy from scratch. Each node starts with beads of its children's bases.
  WrapCounts build(const Balls<Dimension>& balls);
  /// Updates the hierarchy from the bases of the previous time. Unless bases are trusted, all are verified,
  /// and a basis is repaired if beads escaped or became superfluous. With Update::lazy, `balls` must stay at
  /// their address.
  WrapCounts update(const Balls<Dimension>& balls, Update how = Update::blocks);

 private:
  template <class Form>
  WrapCounts wrap(const Balls<Dimension>& balls, bool from_children, Update how);

  NecklaceTree tree_;
  BottomUpOrder order_;
  std::vector<Basis> bases_;
  std::vector<Cage<Dimension>> cages_;  // at the present time
  std::vector<std::uint8_t> loose_;     // beads may be out of the rounded cage by more than 2^-28 of it
  Frontiers frontiers_;
  double wider_ = 0;  // if radii are equal, spheres are wider than cages by this
  const Balls<Dimension>* lazy_ = nullptr;
};

}  // namespace kds
