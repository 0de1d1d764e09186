#pragma once
// The certificates that the nodes of a wrapped hierarchy hold: each bead stays inside the sphere of its
// node's basis, and each basis bead stays outside the sphere of the other basis beads. Certificates are
// enqueued first and then watched together, because four cost little more than one.

#include <array>
#include <concepts>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "kds/kinetic_structure.h"
#include "structures/hierarchy/node_proofs.h"
#include "structures/hierarchy/signs_just_after.h"
#include "structures/necklace/necklace_tree.h"

namespace kds {

/// A bead named by a certificate of a node.
struct NamedBead {
  NodeId node;
  BeadId bead;
};

template <int Dimension>
class NodeCertificates {
 public:
  /// Holds the certificates of `owner`, a structure that has number `index` in the simulator. `curves` are
  /// those of the present step.
  NodeCertificates(Simulator& simulator, KineticStructure& owner, std::size_t index,
                   const MotionRef<Dimension>& motion, const Curves<Dimension>& curves, Radii radii,
                   std::size_t nodes, NodeProofs<Dimension>& proofs);

  [[nodiscard]] SignsJustAfter<Dimension>& signs() { return signs_; }

  /// Forgets all certificates, which the simulator has dropped already.
  void start_step();

  /// enqueue_basis: basis beads must not enter the sphere of the other basis beads; beads with a bit in
  /// `stays` need no certificate. enqueue_beyond: these beads must stay inside.
  void enqueue_basis(NodeId node, const Basis& basis, unsigned stays);
  void enqueue_beyond(NodeId node, const Basis& basis, std::span<const BeadId> beyond);
  /// Watches the enqueued certificates. Returns the beads whose certificates are violated or, unless
  /// `zero_will_do`, zero for the whole step. The result is valid until the next call.
  [[nodiscard]] std::span<const NamedBead> watch_enqueued(bool zero_will_do);
  /// Watches the enqueued certificates of a single node and returns the first such bead, if any. If a
  /// certificate has just failed and would be watched again, returns its bead and watches nothing.
  [[nodiscard]] std::optional<BeadId> watch_enqueued_of_one(bool zero_will_do);

  [[nodiscard]] bool holds_any(NodeId node) const { return held_by_[node].first != none; }
  /// Returns the time by which the node's certificates are made anew at the latest: the first failure of any
  /// of them.
  [[nodiscard]] double certified_until(NodeId node);
  void drop(NodeId node);

  struct Failed {
    NodeId node = 0;
    BeadId bead = no_bead;  ///< the certificate's subject; none for a touch
    bool touches = false;   ///< the certificate touches zero without failing
  };
  /// Takes the certificate that fails now, given by table and slot, and drops all certificates of its node.
  /// Until forget_failure, signs use this failure as the present one, unless it is a touch.
  [[nodiscard]] Failed take_failed(unsigned table, std::uint32_t slot, std::span<const Basis> bases);
  void forget_failure() { signs_.present.reset(); }

  // The beads that enqueued certificates have named since the start of the step or the last failure.

  template <std::predicate<NodeId> Of>
  void forget_named_if(Of of) {
    std::erase_if(named_, [&](const NamedBead& one) { return of(one.node); });
  }
  /// Forgets the beads of `node`, which must be the last node that enqueued.
  void forget_named_of(NodeId node) {
    forget_followed(node);
    while (!named_.empty() && named_.back().node == node) named_.pop_back();
  }
  /// Updates the statistics with the largest number of certificates that name one bead.
  void count_per_bead();

  /// From the next step on, follows how many certificates name each bead.
  void follow_names();
  /// Updates the statistics with the largest number now of certificates that name one of the beads for which
  /// a certificate was made since the last call. Does nothing unless names are followed.
  void count_followed();

 private:
  static constexpr std::uint32_t none = 0xffffffffU;
  static constexpr std::size_t full = Dimension + 1;
  using Tables = MembershipTables<Dimension>;

  struct HeldBy {
    std::uint32_t first = none;       // the node's queued certificates, a list in held_
    std::uint32_t never_failing = 0;  // number of certificates that never fail
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
  void forget_followed(NodeId node) {
    if (followed_.empty()) return;
    for (const BeadId bead : followed_[node]) --named_by_[bead];
    followed_[node].clear();
  }

  Simulator& simulator_;
  KineticStructure& owner_;
  const Curves<Dimension>& curves_;
  Radii radii_;
  NodeProofs<Dimension>& proofs_;
  Tables tables_;
  SignsJustAfter<Dimension> signs_;
  std::vector<HeldBy> held_by_;  // per node
  std::size_t bead_count_;
  std::vector<HeldCertificate> held_;
  std::vector<std::uint32_t> free_;
  std::array<std::vector<BeadId>, Tables::count + 1> watched_;  // enqueued subjects, per table
  std::vector<NamedBead> violated_, named_;
  CertificatesPerBead per_bead_;  // all zero between calls
  // Only if names are followed: the beads that each node's certificates name, one entry per certificate; for
  // each bead the number of these entries; and the beads whose number has risen since count_followed.
  std::vector<std::vector<BeadId>> followed_;
  std::vector<std::uint32_t> named_by_;
  std::vector<BeadId> risen_;
  std::optional<BeadId> failed_again_;  // bead whose certificate failed and would be watched again
};

}  // namespace kds
