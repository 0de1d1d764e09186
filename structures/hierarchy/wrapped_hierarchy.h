#pragma once
// Kinetic wrapped hierarchy, in the plane and in space, radii equal or not: at every internal node of the
// balanced tree over a necklace the minimum enclosing sphere of all its beads, kept as a basis of at most
// dimension + 1 beads. Certificates of a node: each other bead stays inside the sphere of the basis; each
// basis bead stays outside the sphere of its fellows. Those that a bound on the sphere's path proves at once
// are not made. When one fails, the new basis is found among the basis and the bead: by such a bound on what
// is next, or by signs just after the event. Exact with any kernel but `fast`. Spheres may be relaxed: then
// beads may be out by a share of the radius, and events are fewer.
//
// Beads can change course while time runs: a look at all paths and nodes, certificates of those nodes that
// hold the beads, and a repair where one is not right any more. They cannot come and go: the tree is that of
// their necklaces.
//
// It is made of three parts, each with a file of its own: what is proved without certificates
// (node_proofs.h), the certificates that are held (node_guards.h), the repair of a basis (basis_repair.h).

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "certificates/base/relaxation.h"
#include "certificates/types/radii.h"
#include "kds/bead_edits.h"
#include "kds/kinetic_structure.h"
#include "motions/base/bead_range.h"
#include "motions/curves/motion_ref.h"
#include "structures/enclosing_sphere/basis.h"
#include "structures/necklace/necklace_tree.h"
#include "structures/necklace/node_selection.h"

namespace kds {

class Simulator;
struct SmallestSphere;
template <int Dimension>
class Balls;
template <int Dimension>
class BasisRepair;
template <int Dimension>
class NodeGuards;
template <int Dimension>
class NodeProofs;

template <int Dimension>
class WrappedHierarchy final : public KineticStructure, public CourseFollower {
  static_assert(Dimension == 2 || Dimension == 3);

 public:
  static constexpr int dimension = Dimension;

  /// Keeps the selected nodes. `radii`: what is promised of them, for all steps; weights must be equal where
  /// radii are. Where `relaxation` is a share of the radius, a bead escapes when it is out by that: the
  /// basis' minimum enclosing sphere, its radius times one plus that share, holds all beads of the node, and
  /// theirs is no smaller than the basis'. Throws std::invalid_argument where the motion is lifted.
  WrappedHierarchy(Simulator& simulator, const MotionRef<Dimension>& motion,
                   std::span<const BeadRange> necklaces, Radii radii, const NodeSelection& selection = {},
                   const Relaxation& relaxation = {});
  ~WrappedHierarchy() override;

  enum Kind : std::uint8_t { enter, leave, pivot, changes };

  [[nodiscard]] std::string_view name() const override { return "wrapped"; }
  /// Ids: the node's first and last bead, then its new basis; of a change of course the bead.
  [[nodiscard]] std::span<const EventKind> kinds() const override;

  [[nodiscard]] const NecklaceTree& tree() const { return tree_; }
  /// Returns whether the node is kept in this step. Nothing else is known of other nodes. Throws
  /// std::invalid_argument if there is no such node.
  [[nodiscard]] bool keeps(NodeId node) const;
  /// Throws likewise.
  [[nodiscard]] const Basis& basis(NodeId node) const;
  [[nodiscard]] const Relaxation& relaxation() const { return relaxation_; }

  /// From the next step on the nodes that `query` asks for are kept, and no others. Which they are is not
  /// logged: such a run cannot be replayed.
  void keep_what_is_asked_for(NodeQuery query);

  void build() override;
  void start_step() override;
  void fail(unsigned table, std::uint32_t slot) override;
  void apply(const Change& change) override;
  [[nodiscard]] std::optional<std::string> audit(const Dyadic& time) override;

  /// The bases of kept nodes at a frame, none with a bead to spare even where the frame is degenerate.
  [[nodiscard]] std::vector<Basis> bases_at(const Dyadic& time) const;

 private:
  static constexpr std::size_t full = Dimension + 1;
  static constexpr int most_repairs = 64;  // of one node at one time, in `fast`

  [[nodiscard]] bool is_fast() const;
  [[nodiscard]] bool move_together(BeadId a, BeadId b) const;
  /// Two beads and no others, both in the basis, of one radius: nothing to guard unless they are one.
  [[nodiscard]] bool is_lone_pair(NodeId node) const;
  /// A basis of two beads that are one all the time.
  [[nodiscard]] bool is_one_bead(NodeId node) const;
  [[nodiscard]] std::string name_of(NodeId node) const;

  /// Builds the basis of a node at the start, ties aside, and returns its smallest sphere.
  SmallestSphere build_node(NodeId node, const Balls<Dimension>& balls);
  void ask_query();
  /// Sets `wide_` and `pairs_`.
  void sort_kept_nodes();
  /// Guards them all at the start of a step; sets `faults_` of those whose basis is not right.
  void watch_all_nodes();
  /// Repairs the nodes whose basis is not right, and guards them.
  void repair_faults();
  /// Guards a node, repairing its basis while a certificate is violated already; logs the change from
  /// `before`. `risen`: a bead, or none, whose certificate has just failed and that is where it belongs.
  void guard_node(NodeId node, Basis before, BeadId risen);
  /// Guards the node's present basis; the first bead whose certificate is violated, if any.
  [[nodiscard]] std::optional<BeadId> watch_node(NodeId node, BeadId risen);
  /// Enqueues certificates of beads, without those that stay inside as long as the node's others are kept.
  void enqueue_beyond(NodeId node);
  /// The basis of the node's basis and `bead`, which escaped or is to spare; false if it is the same.
  [[nodiscard]] bool repair(NodeId node, BeadId bead, bool failed = false);
  /// From scratch, where doubles contradict themselves.
  void rebuild_roughly(NodeId node);
  void record(NodeId node, const Basis& before);

  void require_release(std::span<const BeadId> beads) const override;
  void release(std::span<const BeadId> beads) override;
  void take_up(std::span<const BeadId> beads) override;

  Simulator& simulator_;
  MotionRef<Dimension> motion_;
  const Radii radii_;
  const Relaxation relaxation_;
  Curves<Dimension> curves_;  // of the present step
  NecklaceTree tree_;
  std::vector<Basis> bases_;        // of nodes
  std::vector<std::uint8_t> kept_;  // a flag a node
  std::size_t index_;
  std::unique_ptr<NodeProofs<Dimension>> proofs_;
  std::unique_ptr<NodeGuards<Dimension>> guards_;
  std::unique_ptr<BasisRepair<Dimension>> repair_;
  NodeQuery query_;
  std::vector<NodeId> wide_, pairs_;  // those that are kept, of more than two beads and of two
  std::vector<NodeId> guarded_;
  std::vector<NodeId> released_;  // that hold beads whose course changes
  enum class BasisFault : std::uint8_t { no, violated, improper };
  std::vector<BasisFault> faults_;   // a node
  std::vector<BeadId> beyond_;       // beads of a node that are not proved to stay inside
  std::vector<BeadId> all_watched_;  // of all nodes at the start of a step, one after another
  std::vector<std::size_t> watched_ends_;
};

}  // namespace kds
