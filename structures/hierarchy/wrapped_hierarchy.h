#pragma once
// Kinetic wrapped hierarchy, in the plane and in space, radii equal or not: at every internal node of the
// balanced tree over a necklace the minimum enclosing sphere of all its beads, kept as a basis of at most
// dimension + 1 beads. Certificates of a node: each other bead stays inside the sphere of the basis; each
// basis bead stays outside the sphere of its fellows. Those that a bound on the sphere's path proves at once
// (sphere_chord.h) are not made. When one fails, the new basis is found among the basis and the bead: by such
// a bound on what is next, or by signs just after the event. Exact with any kernel but `Fast`.

#include <algorithm>
#include <array>
#include <bit>
#include <functional>
#include <numeric>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "motions/curves/positions.h"
#include "structures/enclosing_sphere/basis.h"
#include "structures/enclosing_sphere/basis_edit.h"
#include "structures/enclosing_sphere/enclosing_sphere.h"
#include "structures/enclosing_sphere/integer_balls.h"
#include "structures/enclosing_sphere/membership_signs.h"
#include "structures/hierarchy/membership_tables.h"
#include "structures/hierarchy/node_slack.h"
#include "structures/moving_sphere/beads_beyond.h"
#include "structures/moving_sphere/chord_cache.h"
#include "structures/moving_sphere/chord_filter.h"
#include "structures/moving_sphere/gap_root.h"
#include "structures/necklace/bead_names.h"
#include "structures/necklace/necklace_tree.h"
#include "structures/necklace/node_selection.h"

namespace kds {

/// `radii`: what is promised of them, for all steps. Weights must be equal where radii are.
template <Motion M, Kernel K, Radii radii = Radii::equal>
class WrappedHierarchy final : public KineticStructure {
  static_assert(M::dimension == 2 || M::dimension == 3);
  static_assert(!lifted<M>, "radii between frames would be fictitious");

 public:
  static constexpr int dimension = M::dimension;

  /// Keeps the selected nodes.
  WrappedHierarchy(Simulator& simulator, const M& motion, std::span<const BeadRange> necklaces,
                   const NodeSelection& selection = {})
      : simulator_(simulator),
        motion_(motion),
        tree_(necklaces),
        index_(simulator.add(*this)),
        tables_(simulator, *this, index_, motion,
                []<class C>(std::type_identity<C>) {
                  return turns_over<C> ? TouchPolicy::reported : TouchPolicy::ignored;
                }),
        nodes_(tree_.node_count()),
        kept_(select_nodes(tree_, selection)) {
    sort_kept_nodes();
  }

  enum Kind : std::uint8_t { enter, leave, pivot };

  [[nodiscard]] std::string_view name() const override { return "wrapped"; }
  /// Ids: the node's first and last bead, then its new basis.
  [[nodiscard]] std::span<const EventKind> kinds() const override {
    static constexpr std::array<EventKind, 3> kinds{{{"enter"}, {"leave"}, {"pivot"}}};
    return kinds;
  }

  [[nodiscard]] const NecklaceTree& tree() const { return tree_; }
  /// Whether the node is kept in this step; nothing else is known of one that is not.
  [[nodiscard]] bool keeps(NodeId node) const { return kept_[node] != 0; }
  [[nodiscard]] const Basis& basis(NodeId node) const { return nodes_[node].basis; }

  /// From the next step on the nodes that `query` asks for are kept, and no others. Which they are is not
  /// logged: such a run cannot be replayed.
  void keep_what_is_asked_for(NodeQuery query) { query_ = std::move(query); }

  void build() override;
  void start_step() override;
  void fail(unsigned table, std::uint32_t slot) override;
  void apply(const Change& change) override;
  [[nodiscard]] std::optional<std::string> audit(const Dyadic& time) override;

  /// The bases of kept nodes at a frame, none with a bead to spare even where the frame is degenerate.
  [[nodiscard]] std::vector<Basis> bases_at(const Dyadic& time) const;

 private:
  static constexpr std::uint32_t none = 0xffffffffU;
  static constexpr std::size_t full = dimension + 1;
  static constexpr int most_repairs = 64;  // of one node at one time, in `fast`
  /// As many certificates at least are worth a closer look.
  static constexpr std::size_t few = 4;
  static constexpr std::size_t worth_another_look = radii == Radii::equal ? 3 : 1;
  /// Doubles prove some certificates without looking at them one by one.
  static constexpr bool prunes = !std::same_as<K, Exact>;
  using Tables = MembershipTables<M, K, radii>;
  using Balls = kds::Balls<dimension>;

  /// Certificates of a full basis: it may turn over where one touches zero.
  template <class C>
  static constexpr bool turns_over = C{}.beads.size() == full;

  struct Node {
    Basis basis;
    std::uint32_t held = none;        // its certificates in the queue, a list in held_
    std::uint32_t never_failing = 0;  // how many more it has
  };
  struct HeldCertificate {
    CertificateHandle guard;
    std::uint32_t next;
    std::uint8_t table;
  };
  /// A bead, by a certificate of a node.
  struct NamedBead {
    NodeId node;
    BeadId bead;
  };
  struct PresentFailure {
    Identity identity;
    bool side;  // which side of zero its certificate wants
    /// The certificate itself, of the balls of a full basis and the one that came to its sphere: all
    /// certificates of these have one norm (ball_in_sphere.h).
    std::optional<BallInSphere<dimension, full>> of_full;
  };
  template <class C>
  static constexpr bool of_full_balls = std::same_as<C, BallInSphere<dimension, full>>;
  template <class C>
  static constexpr bool radical_of_two_or_more =
      RadicalCertificateFor<C, M>&& std::tuple_size_v<decltype(C{}.beads)> >= 3;
  template <class C>
  static std::array<BeadId, full + 1> ascending(const C& c) {
    std::array<BeadId, full + 1> beads = c.beads;
    for (std::size_t i = full; i > 0 && beads[i] < beads[i - 1]; --i) std::swap(beads[i], beads[i - 1]);
    return beads;  // the basis was ascending
  }
  /// Whether a certificate has the present root, though it is another function.
  template <class C>
  [[nodiscard]] bool has_present_root(const C& c) const {
    if constexpr (of_full_balls<C>)
      return present_ && present_->of_full && ascending(*present_->of_full) == ascending(c);
    return false;
  }

  /// The sign of a certificate just after now. That of the failing one is known, and so is its function's
  /// elsewhere.
  struct JustAfter {
    WrappedHierarchy& self;
    template <class Certificate>
    int operator()(const Certificate& c) const {
      if (self.present_ && c.identity() == self.present_->identity)
        return c.side() == self.present_->side ? -1 : 1;
      if constexpr (of_full_balls<Certificate> && std::same_as<K, Filtered>) {
        if (self.has_present_root(c)) {
          const int sign = sign_after_failure(c, *self.present_->of_full, self.motion_, self.simulator_.now(),
                                              self.statistics.stages);
          if (sign != 0) return sign;
        }
      }
      return sign_just_after<K>(c, self.motion_, self.simulator_.now(), self.statistics.stages);
    }
  };
  [[nodiscard]] auto signs_just_after() { return MembershipSigns<radii, M, JustAfter>(motion_, {*this}); }

  [[nodiscard]] bool move_together(BeadId a, BeadId b) const {
    for (int k = 0; k <= M::degree; ++k) {
      for (int axis = 0; axis < dimension; ++axis) {
        if (motion_.coordinate(a, k, axis) != motion_.coordinate(b, k, axis)) return false;
      }
    }
    return true;
  }
  [[nodiscard]] Balls balls_at_start() const {
    return Balls(control_points(motion_, 0), control_radii(motion_, 0));
  }
  [[nodiscard]] static unsigned all_of(const Basis& basis) { return (1U << basis.size) - 1U; }
  /// Two beads and no others, both in the basis.
  [[nodiscard]] bool is_pair(NodeId node) const {
    const BeadRange& range = tree_.range(node);
    return (nodes_[node].basis.size == 2) & (range.last - range.first == 1);
  }
  /// Of one radius: nothing to guard unless they are one.
  [[nodiscard]] bool is_lone_pair(NodeId node) const { return radii == Radii::equal && is_pair(node); }
  /// A basis of two beads that are one all the time.
  [[nodiscard]] bool is_one_bead(NodeId node) const {
    const Basis& basis = nodes_[node].basis;
    return radii == Radii::equal && basis.size == 2 && move_together(basis.beads[0], basis.beads[1]);
  }
  /// Its basis at the start, ties aside.
  void build_node(NodeId node, const Balls& balls);
  void ask_query();
  /// Sets `wide_` and `pairs_`.
  void sort_kept_nodes();
  /// Sets `guarded_`: the nodes that are kept and have something to guard.
  void list_guarded_nodes();
  void count_per_bead(std::span<const NamedBead> named);
  /// Doubles prove that it is a basis of its balls.
  [[nodiscard]] bool is_proper_at_start(const Basis& basis) const;
  /// Guards them all at the start of a step; sets `amiss_` of those whose basis is not right.
  void watch_all_nodes();
  /// Guards a node, repairing its basis while a certificate is violated already; logs the change from
  /// `before`.
  void guard_node(NodeId node, Basis before);
  /// Sets `doubtful_` to the guarded nodes that may not be steady in the step, and `all_beyond_` to their
  /// beads that may not stay inside.
  void find_doubtful_nodes();
  [[nodiscard]] Period rest_of_step() const {
    return {simulator_.now().lower(), 1, simulator_.now().upper()};
  }
  [[nodiscard]] unsigned find_beads_to_watch(NodeId node);
  [[nodiscard]] unsigned take_out_staying(NodeId node, const SphereChord<dimension>* chord,
                                          const Period& rest);
  /// The bead whose certificate has just failed, in the new basis or left by it: its own root is the only one
  /// in the bracket, and it is where it belongs just after. Or none.
  [[nodiscard]] BeadId risen_bead(const Basis& old, const Basis& next, BeadId failed) const;
  [[nodiscard]] unsigned look_closely(const Basis& basis, double until);
  /// When the certificates of a node are made anew at the latest.
  [[nodiscard]] double guarded_until(NodeId node);
  /// Takes out of `beyond_` what stays inside for as long as its certificates would be kept.
  void take_out_later(NodeId node);
  /// Guards the node's present basis; the first bead whose certificate is violated, if any.
  [[nodiscard]] std::optional<BeadId> watch_node(NodeId node);
  void enqueue_basis(NodeId node, unsigned stays);
  void enqueue_beyond(NodeId node, std::span<const BeadId> beyond);
  template <class Report>
  void watch_enqueued(bool zero_will_do, Report report);
  [[nodiscard]] std::optional<BeadId> watch_enqueued(bool zero_will_do);
  template <class C>
  [[nodiscard]] std::optional<Failure> crossing_of(const Basis& basis, BeadId bead, bool inside,
                                                   bool at_own_root);
  void enqueue(NodeId node, const Basis& basis, BeadId bead, bool inside, int orientation);
  void hold(NodeId node, CertificateHandle guard, unsigned table);
  void drop_node(NodeId node);
  /// The basis of the node's basis and `bead`, which escaped or is to spare; false if it is the same.
  [[nodiscard]] bool repair(NodeId node, BeadId bead);
  /// The next basis of a node where `bead` is the one whose certificate has just failed, if the sphere's path
  /// proves it.
  [[nodiscard]] std::optional<Basis> proved_next_basis(const Basis& old, BeadId bead);
  [[nodiscard]] unsigned are_proved(std::span<const Basis> bases, BeadId newcomer);
  [[nodiscard]] std::optional<Basis> basis_just_after(std::span<const BeadId> among, const Basis& old,
                                                      BeadId escaped);
  void record(NodeId node, const Basis& before);
  [[nodiscard]] std::string name_of(NodeId node) const {
    const BeadRange& range = tree_.range(node);
    return "node " + std::to_string(range.first) + "-" + std::to_string(range.last);
  }

  Simulator& simulator_;
  const M& motion_;
  NecklaceTree tree_;
  std::size_t index_;
  Tables tables_;
  std::vector<Node> nodes_;
  std::vector<std::uint8_t> kept_;  // a flag a node
  NodeQuery query_;
  std::vector<HeldCertificate> held_;
  std::vector<std::uint32_t> free_;
  BeadPaths<dimension> paths_;
  NodeSlack<dimension> resting_{tree_};
  GapRoots<dimension> gap_roots_;
  std::vector<NodeId> wide_, pairs_;           // those that are kept, of more than two beads and of two
  std::vector<std::uint8_t> apart_from_next_;  // flags of beads
  std::vector<NodeId> guarded_;
  struct ChordCandidate {
    NodeId node;
    SphereChord<dimension> chord;  // of its basis at the start of the step
    std::size_t end;               // of its beads in all_beyond_; where the chord is proved, else it has none
  };
  std::vector<ChordCandidate> doubtful_;
  enum class BasisFault : std::uint8_t { no, violated, improper };
  std::vector<BasisFault> amiss_;  // a node
  ChordCache<dimension> chord_cache_;
  std::array<std::vector<BeadId>, Tables::count + 1>
      watched_;                      // of the certificates that are enqueued, a table
  std::vector<BeadId> beyond_;       // beads of a node that are not proved to stay inside
  std::vector<BeadId> all_beyond_;   // of all nodes at the start of a step, one after another
  std::vector<BeadId> all_watched_;  // the same without those that a closer look proves
  std::vector<std::size_t> watched_ends_;
  std::vector<NamedBead> named_;  // by the certificates of the nodes watched last
  std::vector<NamedBead> named_at_start_;
  std::vector<std::uint32_t> per_bead_;  // certificates that name it, while they are counted
  std::optional<PresentFailure> present_;
  BeadId present_bead_ = no_bead;
  BeadId risen_ = no_bead;              // while its node is watched
  std::optional<BeadId> failed_again_;  // whose certificate has just failed and would be watched once more
};

}  // namespace kds

#include "structures/hierarchy/wrapped_hierarchy_audit.h"
#include "structures/hierarchy/wrapped_hierarchy_build.h"
#include "structures/hierarchy/wrapped_hierarchy_chords.h"
#include "structures/hierarchy/wrapped_hierarchy_guards.h"
#include "structures/hierarchy/wrapped_hierarchy_repairs.h"
#include "structures/hierarchy/wrapped_hierarchy_start.h"
