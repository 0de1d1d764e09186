#pragma once
// What the paths of beads and spheres prove of the nodes of a wrapped hierarchy, so that no certificate is
// needed: nodes that rest (node_slack.h), and beads that stay inside or in their basis (sphere_chord.h). All
// in double; the exact kernel, and motions of a higher degree than paths have, go without.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "certificates/base/relaxation.h"
#include "certificates/types/radii.h"
#include "kds/simulator.h"
#include "motions/curves/curves.h"
#include "structures/enclosing_sphere/basis.h"
#include "structures/hierarchy/node_slack.h"
#include "structures/hierarchy/relaxed_slack.h"
#include "structures/moving_sphere/bead_paths.h"
#include "structures/moving_sphere/chord_cache.h"
#include "structures/moving_sphere/gap_root.h"
#include "structures/moving_sphere/sphere_chord.h"
#include "structures/necklace/necklace_tree.h"

namespace kds {

/// A node that is not proved to be steady in the step.
template <int Dimension>
struct ChordCandidate {
  NodeId node;
  SphereChord<Dimension> chord;  ///< of its basis at the start of the step
  std::size_t end;  ///< of its beads in NodeProofs::beyond(); where no chord is proved it has none there
};

template <int Dimension>
class NodeProofs {
 public:
  static constexpr std::size_t full = Dimension + 1;

  /// `curves`: of the present step, of this degree. Beads stay inside spheres that are relaxed by so much.
  NodeProofs(const Simulator& simulator, const NecklaceTree& tree, const Curves<Dimension>& curves,
             int degree, Radii radii, const Relaxation& relaxation = {});

  /// The curves are those of the next step, or of this one others than they were.
  void take_curves();
  /// The node has got another basis.
  void forget(NodeId node) { slack_.forget(node); }

  // At the start of a step, of many nodes.

  /// Adds those of some nodes of two beads that have something to guard.
  void add_unsettled(std::span<const NodeId> pairs, std::span<const Basis> bases, std::vector<NodeId>& nodes);
  /// Takes out nodes that rest.
  void take_out_resting(std::span<const Basis> bases, std::vector<NodeId>& nodes);
  /// Sets `candidates()` to those of some nodes that may not be steady, and `beyond()` to their beads that
  /// may not stay inside, those of one node after another.
  void find_candidates(std::span<const NodeId> nodes, std::span<const Basis> bases);
  [[nodiscard]] std::span<const ChordCandidate<Dimension>> candidates() const { return candidates_; }
  [[nodiscard]] std::span<const BeadId> beyond() const { return beyond_; }
  /// Doubles prove that it is a basis of its balls.
  [[nodiscard]] bool is_proper_at_start(const Basis& basis) const;
  /// Of a candidate: takes out of `beyond` what more than the chord alone proves to stay inside. Returns a
  /// bit for each bead of the basis that is proved to stay in it. Where no chord is proved it sets `beyond`
  /// first.
  [[nodiscard]] unsigned take_out_staying(const Basis& basis, const BeadRange& range,
                                          const SphereChord<Dimension>& chord, std::vector<BeadId>& beyond);

  // At any time, of one node.

  /// Sets `beyond` to what is not proved to stay inside; the same bits. `risen`: a bead, or none, whose
  /// certificate has just failed, in the new basis or left by it, and which is where it belongs just after.
  [[nodiscard]] unsigned find_beads_to_watch(const Basis& basis, const BeadRange& range, BeadId risen,
                                             std::vector<BeadId>& beyond);
  /// Whether that many beads are worth take_out_until.
  [[nodiscard]] bool worth_another_look(std::size_t beads) const {
    return any_ && beads >= (radii_ == Radii::equal ? 3U : 1U);
  }
  /// Takes out of `beyond` what stays inside until then.
  void take_out_until(double until, const Basis& basis, std::vector<BeadId>& beyond) {
    static_cast<void>(look_closely(basis, until, beyond));
  }
  /// The bead that is known to be where it belongs just after it has failed, of a basis and the next one: its
  /// own root is the only one in the bracket. Or none.
  [[nodiscard]] BeadId risen_bead(const Basis& old, const Basis& next, BeadId failed) const;
  [[nodiscard]] bool proves_bases() const { return any_; }
  /// A bit for each of up to four that is proved to be the basis of its beads just after now, if the newcomer
  /// does not have to be. Of one alone the chord is known then.
  [[nodiscard]] unsigned proved_bases(std::span<const Basis> bases, BeadId newcomer);
  /// The basis of the smallest sphere around those of a basis and a bead just after now, if it is proved to
  /// be of the bead and some of the others, the rest strictly inside: no other basis will do then.
  [[nodiscard]] std::optional<Basis> proved_basis_with(const Basis& old, BeadId bead);
  /// Whether `crossing` proves anything: radii unequal, motion linear, kernel `filtered`.
  [[nodiscard]] bool proves_crossings() const { return proves_crossings_; }
  /// The first failure of the certificate of a bead and a basis of two or more. At its own root it is known
  /// to hold just after now.
  [[nodiscard]] std::optional<Failure> crossing(const Basis& basis, BeadId bead, bool inside,
                                                bool at_own_root);

 private:
  /// As many certificates at least are worth a closer look.
  static constexpr std::size_t few = 4;

  [[nodiscard]] static unsigned all_of(const Basis& basis) { return (1U << basis.size) - 1U; }
  [[nodiscard]] Period rest_of_step() const {
    return {simulator_.now().lower(), 1, simulator_.now().upper()};
  }
  [[nodiscard]] unsigned take_out_staying(const Basis& basis, const BeadRange& range,
                                          const SphereChord<Dimension>* chord, const Period& rest,
                                          BeadId risen, std::vector<BeadId>& beyond);
  [[nodiscard]] unsigned look_closely(const Basis& basis, double until, std::vector<BeadId>& beyond);

  /// The chords of up to four bases of one size from now on for a little while; of one or two they are
  /// followed by those until the end of the step, for the cache.
  struct ChordsAhead {
    Period soon;
    std::array<SphereChord<Dimension>, 4> chords;
  };
  [[nodiscard]] ChordsAhead chords_ahead(std::span<const Basis> bases) const;
  void keep_rest(std::span<const Basis> bases, std::size_t place, ChordsAhead& ahead);

  void relax(const Basis& basis, SphereChord<Dimension>& chord) const {
    chord.enlarge(enlarged_by_);
    if (!slack_of_relaxed_.any()) return;
    const double raised_by = slack_of_relaxed_.of(curves_, basis);
    for (double& limit : chord.limit) limit += raised_by;
  }

  const Simulator& simulator_;
  const NecklaceTree& tree_;
  const Curves<Dimension>& curves_;
  Radii radii_;
  bool any_, proves_crossings_;
  double enlarged_by_;             // by which chords are, of equal radii
  RelaxedSlack slack_of_relaxed_;  // by which limits are raised, of others
  BeadPaths<Dimension> paths_;
  NodeSlack<Dimension> slack_;
  ChordCache<Dimension> chord_cache_;
  GapRoots<Dimension> gap_roots_;
  std::vector<ChordCandidate<Dimension>> candidates_;
  std::vector<BeadId> beyond_;
  std::vector<BeadId> left_out_;
  std::vector<std::uint8_t> apart_from_next_;  // flags of beads
};

}  // namespace kds
