#pragma once
// Wrapped hierarchy of a scene at one time, and from one sampled time to the next: at every internal node of
// the balanced tree over a necklace the minimum enclosing sphere of its beads, by its basis (the paper's
// section 2). In the plane and in space; equal radii take the cheaper sphere of centres. Bases are exact:
// each encloses its beads and has none to spare, decided in double with proved errors or else in exact
// arithmetic; centres and radii are rounded, radii to 1e-12 of their size and better. Work: about n log n
// bead tests at worst to build or update, a few a node where beads clearly inside are settled by the cages of
// children.

#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "structures/enclosing_sphere/basis.h"
#include "structures/enclosing_sphere/cage.h"
#include "structures/hierarchy/bottom_up_order.h"
#include "structures/hierarchy/threads.h"
#include "structures/necklace/balls.h"
#include "structures/necklace/necklace_tree.h"

namespace kds {

/// How a hierarchy is brought to another time.
enum class Update : std::uint8_t {
  naive,    ///< every bead of every node is tested
  cascade,  ///< cages below first, down to beads where they are not inside; starts from where it ended last
  blocks,   ///< the same for large nodes, small ones bead by bead, eight at a time: the fastest
  trust,    ///< spheres of the old bases, nothing tested: beads may stick out
  lazy      ///< nothing is done until a sphere is asked for, which is then one of an old basis
};

/// What was done to all nodes.
struct WrapCounts {
  std::uint64_t pivots = 0;      ///< in which one bead came into a basis
  std::uint64_t changed = 0;     ///< nodes with another basis than before
  std::uint64_t exact = 0;       ///< nodes that took exact arithmetic
  std::uint64_t bead_tests = 0;  ///< beads tested against a sphere, those of its basis left out by `cascade`
  std::uint64_t cage_tests = 0;  ///< cages tested against a sphere
  std::uint64_t frontier = 0;    ///< cages and beads at which `cascade` ended, of all nodes

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

/// Where the cascade of each node ended, to start from there next time. Nodes, and beads counted on from
/// 2^31; of each run of the order one list.
struct Frontiers {
  static constexpr std::uint32_t bead = 0x80000000U;
  std::vector<std::vector<std::uint32_t>> of_run;
  std::vector<BottomUpOrder::Group> of_node;  ///< places in the run's list; empty: none known
};

template <int Dimension>
class StaticWrappedHierarchy {
 public:
  static constexpr int dimension = Dimension;
  using BallsAt = Balls<Dimension>;

  explicit StaticWrappedHierarchy(std::span<const BeadRange> necklaces);

  [[nodiscard]] const NecklaceTree& tree() const { return tree_; }
  /// After Update::trust or lazy: of the last verified time.
  [[nodiscard]] const Basis& basis(NodeId node) const { return bases_[node]; }
  [[nodiscard]] std::span<const Basis> bases() const { return bases_; }
  /// Gives its cages away for the memory of others, to make them anew with the next build or update: until
  /// then it has bases, and no spheres. They are of centres where radii are equal, spheres being wider by
  /// `wider_than_cages`.
  void exchange_cages(std::vector<Cage<Dimension>>& others) {
    others.resize(cages_.size());
    cages_.swap(others);
  }
  [[nodiscard]] double wider_than_cages() const { return wider_; }
  /// Nodes of whose cages doubles have not proved how far beads may be out: exact arithmetic decided, or the
  /// centre has lost digits far from the origin.
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
  /// The smallest sphere around the node's balls; after Update::trust or lazy around those of its basis.
  [[nodiscard]] Sphere sphere(NodeId node) const;

  /// From scratch; each node starts with beads of its children's bases. The same bits whatever `threads`.
  WrapCounts build(const Balls<Dimension>& balls, Threads threads = Threads::one);
  /// From the bases of the time before. Unless they are trusted, all are verified, and those of which beads
  /// escaped or that have beads to spare are repaired. With Update::lazy `balls` must stay where they are.
  WrapCounts update(const Balls<Dimension>& balls, Update how = Update::blocks,
                    Threads threads = Threads::one);

  /// After Update::trust or lazy: by how much a bead of the node may stick out of its sphere at most, if none
  /// has moved farther than `moved` since the last verified time (greatest_move). With p, z, R now and p',
  /// z', R' then: |p - z| - R <= |p - p'| + |p' - z'| + |z' - z| - R <= moved + R' + |z' - z| - R.
  [[nodiscard]] double stick_out(NodeId node, double moved) const;

 private:
  template <class Form>
  WrapCounts wrap(const Balls<Dimension>& balls, bool from_children, Update how, Threads threads);

  NecklaceTree tree_;
  BottomUpOrder order_;
  std::vector<Basis> bases_;
  std::vector<Cage<Dimension>> cages_;     // of the present time
  std::vector<Cage<Dimension>> verified_;  // of the last verified one, where the present is another
  std::vector<std::uint8_t> loose_;        // beads may be out of the rounded cage by more than 2^-28 of it
  Frontiers frontiers_;
  double wider_ = 0;  // cages are of centres if radii are equal: by how much spheres are wider
  bool trusting_ = false;
  const Balls<Dimension>* lazy_ = nullptr;
};

/// How far the bead that moved farthest has moved, rounded up.
template <int Dimension>
[[nodiscard]] double greatest_move(const Balls<Dimension>& from, const Balls<Dimension>& to);

}  // namespace kds
