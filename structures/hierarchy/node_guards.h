#pragma once
// The certificates that the nodes of a wrapped hierarchy hold: each bead stays inside the sphere of its
// node's basis, each basis bead outside the sphere of its fellows. Certificates are enqueued and then watched
// together, since four cost little more than one.

#include <array>
#include <concepts>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "certificates/base/relaxation.h"
#include "kds/kinetic_structure.h"
#include "structures/hierarchy/membership_tables.h"
#include "structures/hierarchy/node_proofs.h"
#include "structures/hierarchy/signs_just_after.h"
#include "structures/necklace/necklace_tree.h"

namespace kds {

/// A bead, by a certificate of a node.
struct NamedBead {
  NodeId node;
  BeadId bead;
};

template <int Dimension>
class NodeGuards {
 public:
  /// Of the structure `owner`, number `index` of the simulator's. `curves`: of the present step.
  NodeGuards(Simulator& simulator, KineticStructure& owner, std::size_t index,
             const MotionRef<Dimension>& motion, const Curves<Dimension>& curves, Radii radii,
             std::size_t nodes, NodeProofs<Dimension>& proofs, const Relaxation& relaxation = {});

  [[nodiscard]] SignsJustAfter<Dimension>& signs() { return signs_; }

  /// Forgets all certificates: the simulator has dropped them.
  void start_step();

  /// The basis beads that are not known to stay must leave no sphere of their fellows.
  void enqueue_basis(NodeId node, const Basis& basis, unsigned stays);
  void enqueue_beyond(NodeId node, const Basis& basis, std::span<const BeadId> beyond);
  /// Guards nodes by the certificates enqueued. Those that are violated or, unless `zero_will_do`, zero for
  /// the whole step: valid until the next call.
  [[nodiscard]] std::span<const NamedBead> watch_enqueued(bool zero_will_do);
  /// The same of one node: the first such bead, if any. Where a certificate has just failed and would be
  /// watched once more, it is that one's, and nothing is watched.
  [[nodiscard]] std::optional<BeadId> watch_enqueued_of_one(bool zero_will_do);

  [[nodiscard]] bool holds_any(NodeId node) const { return held_by_[node].first != none; }
  /// When the certificates of a node are made anew at the latest: at the first failure of any of them.
  [[nodiscard]] double guarded_until(NodeId node);
  void drop(NodeId node);

  struct Failed {
    NodeId node = 0;
    BeadId bead = no_bead;  ///< that the certificate is about, unless
    bool touches = false;   ///< it does not fail, but touches zero
    bool relaxed = false;   ///< the bead is as far outside as it may be, not on the sphere
  };
  /// What fails now, by table and slot, with all the certificates of its node dropped. Until `forget_failure`
  /// the failure is known to be the present one, unless it is a touch.
  [[nodiscard]] Failed take_failed(unsigned table, std::uint32_t slot, std::span<const Basis> bases);
  void forget_failure() { signs_.present.reset(); }

  // Which beads enqueued certificates name since the step's start or the last failure.

  template <std::predicate<NodeId> Of>
  void forget_named_if(Of of) {
    std::erase_if(named_, [&](const NamedBead& one) { return of(one.node); });
  }
  /// Of the node that was the last to enqueue any.
  void forget_named_of(NodeId node) {
    while (!named_.empty() && named_.back().node == node) named_.pop_back();
  }
  /// The most that name one bead go into the statistics.
  void count_per_bead();

 private:
  static constexpr std::uint32_t none = 0xffffffffU;
  static constexpr std::size_t full = Dimension + 1;
  using Tables = MembershipTables<Dimension>;

  struct HeldBy {
    std::uint32_t first = none;       // its certificates in the queue, a list in held_
    std::uint32_t never_failing = 0;  // how many more it has
  };
  struct HeldCertificate {
    CertificateHandle handle;
    std::uint32_t next;
    std::uint8_t table;
  };

  void enqueue(NodeId node, const Basis& basis, BeadId bead, bool inside, int orientation);
  template <class Certificate>
  [[nodiscard]] std::optional<Failure> crossing_of(const Basis& basis, BeadId bead, bool inside,
                                                   bool at_own_root);
  void hold(NodeId node, CertificateHandle handle, unsigned table);

  Simulator& simulator_;
  KineticStructure& owner_;
  const Curves<Dimension>& curves_;
  Radii radii_;
  Relaxation relaxation_;
  NodeProofs<Dimension>& proofs_;
  Tables tables_;
  SignsJustAfter<Dimension> signs_;
  std::vector<HeldBy> held_by_;  // a node
  std::vector<HeldCertificate> held_;
  std::vector<std::uint32_t> free_;
  std::array<std::vector<BeadId>, Tables::count + 1> watched_;  // by what is enqueued, a table
  std::vector<NamedBead> violated_, named_;
  std::vector<std::uint32_t> per_bead_;  // certificates that name it, while they are counted
  std::optional<BeadId> failed_again_;   // whose certificate has just failed and would be watched once more
};

}  // namespace kds
