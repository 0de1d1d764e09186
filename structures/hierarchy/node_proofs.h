#pragma once
// Proofs that make certificates of a wrapped hierarchy's nodes unnecessary, from the paths of beads and
// spheres. Slack (a distance) proves whole nodes, which the step skips (node_slack.h). Filters (floating
// point with proved bounds) prove that beads stay inside or stay in their basis (sphere_chord.h). There is no
// lookahead here, which power diagrams have (facet_proofs.h). All proofs run in double. The exact kernel, and
// motions whose degree exceeds that of paths, have no proofs.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "certificates/base/radical.h"
#include "kds/simulator.h"
#include "motions/curves/curves.h"
#include "structures/enclosing_sphere/basis.h"
#include "structures/hierarchy/node_slack.h"
#include "structures/moving_sphere/bead_paths.h"
#include "structures/moving_sphere/gap_root.h"
#include "structures/moving_sphere/sphere_chord.h"
#include "structures/necklace/necklace_tree.h"

namespace kds {

/// A node that is not proved steady in the step.
template <int Dimension>
struct ChordCandidate {
  NodeId node;
  SphereChord<Dimension> chord;  ///< of the sphere of the node's basis at the start of the step
  std::size_t end;  ///< end of its beads in NodeProofs::beyond(); without a proved chord it has none there
};

template <int Dimension>
class NodeProofs {
 public:
  static constexpr std::size_t full = Dimension + 1;

  /// `curves` are those of the present step, with this degree.
  NodeProofs(const Simulator& simulator, const NecklaceTree& tree, const Curves<Dimension>& curves,
             int degree, Radii radii);

  /// Takes the curves of the next step, or changed curves of this one.
  void take_curves();
  /// Must be called when the node's basis changes.
  void forget(NodeId node) { slack_.forget(node); }

  // For many nodes, at the start of a step.

  /// Adds to `nodes` the nodes of two beads in `pairs` that need a certificate.
  void add_unsettled(std::span<const NodeId> pairs, std::span<const Basis> bases, std::vector<NodeId>& nodes);
  /// Removes nodes that slack lets the step skip.
  void take_out_skipped(std::span<const Basis> bases, std::vector<NodeId>& nodes);
  /// Sets `candidates()` to the given nodes that may not be steady, and `beyond()` to their beads that may
  /// not stay inside, node by node.
  void find_candidates(std::span<const NodeId> nodes, std::span<const Basis> bases);
  [[nodiscard]] std::span<const ChordCandidate<Dimension>> candidates() const { return candidates_; }
  [[nodiscard]] std::span<const BeadId> beyond() const { return beyond_; }
  /// Returns whether doubles prove the basis proper for its balls at the start.
  [[nodiscard]] bool is_proper_at_start(const Basis& basis) const;
  /// Tries finer proofs for the beads of a candidate node than its chord alone. Removes the beads that are
  /// proved to stay inside from `beyond`; if no chord is proved, `beyond` first becomes all beads outside the
  /// basis. In the result, bit i says that bead i of the basis is proved to stay in the basis.
  [[nodiscard]] unsigned take_out_staying(const Basis& basis, const BeadRange& range,
                                          const SphereChord<Dimension>& chord, std::vector<BeadId>& beyond);

  // For a single node, at any time.

  /// Sets `beyond` to the beads that are not proved to stay inside, and returns the bits of take_out_staying.
  /// `risen` is no_bead or a bead of the new or the old basis whose certificate has just failed and which is
  /// on its proper side just after.
  [[nodiscard]] unsigned find_beads_to_watch(const Basis& basis, const BeadRange& range, BeadId risen,
                                             std::vector<BeadId>& beyond);
  /// Returns whether take_out_until is worthwhile for this many beads.
  [[nodiscard]] bool worth_another_look(std::size_t beads) const {
    return any_ && beads >= (radii_ == Radii::equal ? 3U : 1U);
  }
  /// Removes from `beyond` the beads that stay inside until time `until`.
  void take_out_until(double until, const Basis& basis, std::vector<BeadId>& beyond) {
    static_cast<void>(look_closely(basis, until, beyond));
  }
  /// Returns the failed bead if it is known to be on its proper side just after the failure, for the old and
  /// the next basis: its own root is the only one in the bracket. Otherwise returns no_bead.
  [[nodiscard]] BeadId risen_bead(const Basis& old, const Basis& next, BeadId failed) const;
  [[nodiscard]] bool proves_bases() const { return any_; }
  /// Returns a bit for each of up to four bases that is proved to be the basis of its beads just after now.
  /// The newcomer need not be proved to stay. With a single basis, its chord is cached as well.
  [[nodiscard]] unsigned proved_bases(std::span<const Basis> bases, BeadId newcomer);
  /// Returns whether `crossing` can prove anything: radii are unequal, the motion is linear and the kernel is
  /// `filtered`.
  [[nodiscard]] bool proves_crossings() const { return proves_crossings_; }
  /// Returns the first failure of the certificate of a bead and a basis of two or more beads. `at_own_root`
  /// means that the certificate holds just after now, which is its own root.
  [[nodiscard]] std::optional<Failure> crossing(const Basis& basis, BeadId bead, bool inside,
                                                bool at_own_root);

 private:
  /// Least number of certificates that is worth a closer look.
  static constexpr std::size_t few = 4;

  [[nodiscard]] static unsigned all_of(const Basis& basis) { return (1U << basis.size) - 1U; }
  [[nodiscard]] Period rest_of_step() const {
    return {simulator_.now().lower(), 1, simulator_.now().upper()};
  }
  [[nodiscard]] unsigned take_out_staying(const Basis& basis, const BeadRange& range,
                                          const SphereChord<Dimension>* chord, const Period& rest,
                                          BeadId risen, std::vector<BeadId>& beyond);
  [[nodiscard]] unsigned look_closely(const Basis& basis, double until, std::vector<BeadId>& beyond);

  const Simulator& simulator_;
  const NecklaceTree& tree_;
  const Curves<Dimension>& curves_;
  Radii radii_;
  bool any_, proves_crossings_;
  BeadPaths<Dimension> paths_;
  NodeSlack<Dimension> slack_;
  ChordCache<Dimension> chord_cache_;
  GapRoots<Dimension> gap_roots_;
  std::vector<ChordCandidate<Dimension>> candidates_;
  std::vector<BeadId> beyond_;
  std::vector<std::uint8_t> apart_from_next_;  // one flag per bead
};

}  // namespace kds
