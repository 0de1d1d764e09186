#pragma once
// Kinetic wrapped hierarchy, in the plane and in space, for equal or unequal radii. Each internal node of the
// balanced tree over a necklace has the minimum enclosing sphere of its beads, stored as a basis of at most
// dimension + 1 beads.
//
// A node's certificates state that each other bead stays inside the sphere of the basis and that each basis
// bead stays outside the sphere of the other basis beads. Certificates that a bound of the sphere's path
// proves at once are not created. When a certificate fails, the new basis is found among the basis and the
// bead, either by such a bound on the next sphere or by signs just after the event. The result is exact.
//
// Beads can change course while time runs. A change of course costs a pass over all paths and nodes, the
// certificates of the nodes that hold the beads, and a repair for each basis that is no longer right. Beads
// cannot be inserted or erased, because the tree depends on the necklaces.
//
// The class has three parts, each in its own file: proofs that replace certificates (node_proofs.h), the
// certificates held (node_certificates.h), and the repair of a basis (signs_just_after.h).

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "certificates/base/radical.h"
#include "kds/kinetic_structure.h"
#include "motions/base/bead.h"
#include "motions/curves/motion_ref.h"
#include "structures/enclosing_sphere/basis.h"
#include "structures/necklace/necklace_tree.h"

namespace kds {

class Simulator;
struct SmallestSphere;
template <int Dimension>
class Balls;
template <int Dimension>
class BasisRepair;
template <int Dimension>
class NodeCertificates;
template <int Dimension>
class NodeProofs;

template <int Dimension>
class WrappedHierarchy final : public KineticStructure, public CourseFollower {
  static_assert(Dimension == 2 || Dimension == 3);

 public:
  static constexpr int dimension = Dimension;

  /// Maintains the selected nodes. `radii` is a promise for all steps; if it promises equal radii, weights
  /// must be equal too. Throws std::invalid_argument if the motion is lifted.
  WrappedHierarchy(Simulator& simulator, const MotionRef<Dimension>& motion,
                   std::span<const BeadRange> necklaces, Radii radii, const NodeSelection& selection = {});
  ~WrappedHierarchy() override;

  enum Kind : std::uint8_t { enter, leave, pivot, changes };

  [[nodiscard]] std::string_view name() const override { return "wrapped"; }
  /// The ids are the node's first and last bead, then its new basis; for a change of course, the bead.
  [[nodiscard]] std::span<const EventKind> kinds() const override;

  [[nodiscard]] const NecklaceTree& tree() const { return tree_; }
  /// Returns whether the node is kept in this step. The bases of other nodes are out of date. Throws
  /// std::invalid_argument if there is no such node.
  [[nodiscard]] bool keeps(NodeId node) const;
  /// Throws std::invalid_argument if there is no such node.
  [[nodiscard]] const Basis& basis(NodeId node) const;

  /// From the next step on, keeps only the nodes that `query` asks for. The choice is not logged, so such a
  /// run cannot be replayed.
  void keep_what_is_asked_for(NodeQuery query);

  void build() override;
  void start_step() override;
  /// From the next step on, follows how many certificates name each bead, at any time.
  void follow_certificates();
  /// Updates statistics.certificates.per_bead_max, the largest number of certificates on one bead. Counts at
  /// the starts of steps only, unless certificates are followed. Certificates that slack makes needless are
  /// not counted.
  void count_certificates();
  void fail(unsigned table, std::uint32_t slot) override;
  void apply(const Change& change) override;
  [[nodiscard]] std::optional<std::string> audit(const Dyadic& time) override;

  /// Returns the bases of kept nodes at a frame, without superfluous beads even if the frame is degenerate.
  [[nodiscard]] std::vector<Basis> bases_at(const Dyadic& time) const;

 private:
  static constexpr std::size_t full = Dimension + 1;

  [[nodiscard]] bool move_together(BeadId a, BeadId b) const;
  /// Returns whether the node consists of two beads of equal radius that are both in the basis. Such beads
  /// need no certificate unless they coincide.
  [[nodiscard]] bool is_lone_pair(NodeId node) const;
  /// Returns whether the basis consists of two beads that coincide all the time.
  [[nodiscard]] bool is_one_bead(NodeId node) const;
  [[nodiscard]] std::string name_of(NodeId node) const;

  /// Builds the basis of a node at the start, ties aside, and returns its smallest sphere.
  SmallestSphere build_node(NodeId node, const Balls<Dimension>& balls);
  void ask_query();
  /// Sets `wide_` and `pairs_`.
  void sort_kept_nodes();
  /// Creates the certificates of all nodes at the start of a step. Sets `faults_` for the nodes whose basis
  /// is not right.
  void watch_all_nodes();
  /// Repairs the nodes whose basis is not right, and creates their certificates.
  void repair_faults();
  /// Creates the certificates of a node, and repairs its basis while a certificate is violated already. Logs
  /// the change from `before`. `risen` is no_bead or a bead whose certificate has just failed and that is on
  /// its proper side now.
  void certify_node(NodeId node, Basis before, BeadId risen);
  /// Creates the certificates of the node's present basis, and returns the first bead whose certificate is
  /// violated, if any.
  [[nodiscard]] std::optional<BeadId> watch_node(NodeId node, BeadId risen);
  /// Enqueues certificates of beads, except beads that stay inside as long as the node's other certificates
  /// are kept.
  void enqueue_beyond(NodeId node);
  /// Replaces the node's basis by that of its beads and `bead`, which has escaped or is superfluous. Returns
  /// false if the basis stays unchanged.
  [[nodiscard]] bool repair(NodeId node, BeadId bead, bool failed = false);
  void record(NodeId node, const Basis& before);

  void require_release(std::span<const BeadId> beads) const override;
  void release(std::span<const BeadId> beads) override;
  void take_up(std::span<const BeadId> beads) override;

  Simulator& simulator_;
  MotionRef<Dimension> motion_;
  const Radii radii_;
  Curves<Dimension> curves_;  // in the present step
  NecklaceTree tree_;
  std::vector<Basis> bases_;        // for each node
  std::vector<std::uint8_t> kept_;  // one flag per node
  std::size_t index_;
  std::unique_ptr<NodeProofs<Dimension>> proofs_;
  std::unique_ptr<NodeCertificates<Dimension>> certificates_;
  std::unique_ptr<BasisRepair<Dimension>> repair_;
  NodeQuery query_;
  std::vector<NodeId> wide_, pairs_;  // kept nodes of more than two beads, and of two
  std::vector<NodeId> to_certify_;
  std::vector<NodeId> released_;  // nodes that hold beads whose course changes
  enum class BasisFault : std::uint8_t { no, violated, improper };
  std::vector<BasisFault> faults_;   // one per node
  std::vector<BeadId> beyond_;       // beads of a node that are not proved to stay inside
  std::vector<BeadId> all_watched_;  // for all nodes at the start of a step, node by node
  std::vector<std::size_t> watched_ends_;
};

}  // namespace kds
