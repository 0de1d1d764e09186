#pragma once
// Kinetic wrapped hierarchy, in the plane and in space, radii equal or not: at every internal node of the
// balanced tree over a necklace the minimum enclosing sphere of all its beads, kept as a basis of at most
// dimension + 1 beads. Certificates of a node: each other bead stays inside the sphere of the basis; each
// basis bead stays outside the sphere of its fellows. Those that a bound on the sphere's path proves at once
// (sphere_path.h) are not made. When one fails, the new basis is found among the basis and the bead, just
// after the event. Exact with any kernel but `Fast`.

#include <algorithm>
#include <array>
#include <functional>
#include <numeric>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "motions/positions.h"
#include "structures/basis.h"
#include "structures/basis_edit.h"
#include "structures/bead_names.h"
#include "structures/membership_signs.h"
#include "structures/membership_tables.h"
#include "structures/necklace_tree.h"
#include "structures/node_selection.h"
#include "structures/smallest_sphere.h"
#include "structures/sphere_path.h"
#include "structures/whole_balls_at.h"

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
                  return turns_over<C> ? Touches::reported : Touches::ignored;
                }),
        nodes_(tree_.node_count()),
        kept_(select_nodes(tree_, selection)) {}

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
  struct Held {
    Guard guard;
    std::uint32_t next;
    std::uint8_t table;
  };
  struct Present {
    Identity identity;
    bool side;  // which side of zero its certificate wants
    /// Balls of a full basis and the one that came to its sphere, ascending: all certificates of theirs have
    /// one norm (ball_in_sphere.h).
    std::optional<std::array<BeadId, full + 1>> tangent;
  };
  template <class C>
  static constexpr bool of_full_balls = std::same_as<C, BallInSphere<dimension, full>>;
  template <class C>
  static std::array<BeadId, full + 1> ascending(const C& c) {
    std::array<BeadId, full + 1> beads = c.beads;
    for (std::size_t i = full; i > 0 && beads[i] < beads[i - 1]; --i) std::swap(beads[i], beads[i - 1]);
    return beads;  // the basis was ascending
  }
  /// Whether a certificate has the present root, though it is another function.
  template <class C>
  [[nodiscard]] bool has_present_root(const C& c) const {
    if constexpr (of_full_balls<C>) return present_ && present_->tangent == ascending(c);
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
          const int sign =
              sign_after_root_of_norm(c, self.motion_, self.simulator_.now(), self.statistics.stages);
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
  /// Its basis at the start, ties aside.
  void build_node(NodeId node, const Balls& balls);
  void ask_query();
  /// Guards a node, repairing its basis while a certificate is violated already; logs the change from
  /// `before`.
  void guard_node(NodeId node, Basis before);
  [[nodiscard]] unsigned find_beads_to_watch(NodeId node);
  /// Guards the node's present basis; the first bead whose certificate is violated, if any.
  [[nodiscard]] std::optional<BeadId> watch_node(NodeId node);
  [[nodiscard]] std::optional<BeadId> watch_enqueued(NodeId node, bool zero_will_do);
  void enqueue(NodeId node, const Basis& basis, BeadId bead, bool inside, int orientation);
  void hold(NodeId node, Guard guard, unsigned table);
  void drop_node(NodeId node);
  /// The basis of the node's basis and `bead`, which escaped or is to spare; false if it is the same.
  [[nodiscard]] bool repair(NodeId node, BeadId bead);
  /// The next basis of a node where `bead` is the one whose certificate has just failed, if the sphere's path
  /// proves it.
  [[nodiscard]] std::optional<Basis> proved_next_basis(const Basis& old, BeadId bead);
  [[nodiscard]] const SphereChord<dimension>& chord_of(const Basis& basis);
  [[nodiscard]] bool is_proved(const Basis& basis, BeadId newcomer);
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
  std::vector<Held> held_;
  std::vector<std::uint32_t> free_;
  BeadPaths<dimension> paths_;
  SphereChord<dimension> chord_;  // of this basis from that time on
  Basis chord_basis_;
  double chord_from_ = -1;
  std::array<std::vector<BeadId>, Tables::count + 1>
      watched_;                          // of the certificates that are enqueued, a table
  std::vector<BeadId> beyond_;           // beads of a node that are not proved to stay inside
  std::vector<BeadId> named_;            // by the certificates of the node watched last
  std::vector<std::uint64_t> per_bead_;  // certificates that name it, at the start of a step
  std::optional<Present> present_;
  BeadId present_bead_ = no_bead;
  std::optional<BeadId> failed_again_;  // whose certificate has just failed and would be watched once more
};

template <Motion M, Kernel K, Radii radii>
void WrappedHierarchy<M, K, radii>::build_node(NodeId id, const Balls& balls) {
  const BeadRange range = tree_.range(id);
  std::vector<BeadId> guess{range.first, range.last};
  for (const NodeId child : {tree_.left(id), tree_.right(id)}) {
    if (child != NecklaceTree::leaf)
      guess.insert(guess.end(), nodes_[child].basis.begin(), nodes_[child].basis.end());
  }
  nodes_[id].basis = smallest_sphere(balls, range.first, range.last, guess).basis;
}

template <Motion M, Kernel K, Radii radii>
void WrappedHierarchy<M, K, radii>::build() {
  if (query_) kept_.assign(nodes_.size(), 0);  // it has not asked yet
  const Balls balls = balls_at_start();
  auto signs = signs_just_after();
  for (auto id = static_cast<NodeId>(nodes_.size()); id-- > 0;) {  // children first
    if (!keeps(id)) continue;
    build_node(id, balls);
    // Put right for the moment after the start: beads on the sphere may leave it.
    const BeadRange range = tree_.range(id);
    bool settled = false;
    for (int i = 0; !settled && (i < most_repairs || !std::same_as<K, Fast>); ++i) {
      settled = true;
      const int orientation = orientation_of(nodes_[id].basis, signs);
      for (BeadId b = range.first; b <= range.last; ++b) {
        if (nodes_[id].basis.contains(b) || is_inside(nodes_[id].basis, b, orientation, signs)) continue;
        settled = !repair(id, b);
        break;
      }
    }
  }
}

template <Motion M, Kernel K, Radii radii>
void WrappedHierarchy<M, K, radii>::ask_query() {
  const Balls balls = balls_at_start();
  const std::vector<std::uint8_t> known = std::exchange(kept_, std::vector<std::uint8_t>(nodes_.size(), 0));
  query_([&](NodeId id) {
    if (id >= nodes_.size()) throw std::invalid_argument("the hierarchy has no such node");
    if (kept_[id] == 0 && known[id] == 0) build_node(id, balls);
    kept_[id] = 1;
    return exact_sphere_of(nodes_[id].basis, balls);
  });
}

template <Motion M, Kernel K, Radii radii>
void WrappedHierarchy<M, K, radii>::start_step() {
  if (query_) ask_query();
  for (Node& node : nodes_) {
    node.held = none;
    node.never_failing = 0;
  }
  held_.clear();
  free_.clear();
  if constexpr (prunes) {
    paths_.set(motion_);
    chord_from_ = -1;
  }
  // Balls that are not independent need not have a sphere: then the basis is found anew before it is guarded.
  std::optional<Balls> balls;
  if constexpr (radii == Radii::any) balls = balls_at_start();
  per_bead_.assign(motion_.bead_count(), 0);
  for (NodeId id = 0; id < nodes_.size(); ++id) {
    if (!keeps(id)) continue;
    const Basis before = nodes_[id].basis;
    if (balls && !is_certainly_proper(*balls, before)) static_cast<void>(repair(id, no_bead));
    guard_node(id, before);
    for (const BeadId b : named_) ++per_bead_[b];
  }
  const auto most = std::max_element(per_bead_.begin(), per_bead_.end());
  auto& per_bead_max = statistics.certificates.per_bead_max;
  if (most != per_bead_.end()) per_bead_max = std::max(per_bead_max, *most);
}

template <Motion M, Kernel K, Radii radii>
std::optional<Basis> WrappedHierarchy<M, K, radii>::basis_just_after(std::span<const BeadId> among,
                                                                     const Basis& old, BeadId escaped) {
  auto signs = signs_just_after();
  if constexpr (radii == Radii::any) {
    return BasisOfBalls(among, signs).find();
  } else {
    BasisHint hint{std::max<std::size_t>(1, old.size - 1U)};
    if (escaped != no_bead) hint = {old.size, escaped};  // it is outside the sphere of all the others
    auto basis = basis_of_points(among, signs, hint);
    return basis || escaped == no_bead ? basis : basis_of_points(among, signs);
  }
}

template <Motion M, Kernel K, Radii radii>
const SphereChord<WrappedHierarchy<M, K, radii>::dimension>& WrappedHierarchy<M, K, radii>::chord_of(
    const Basis& basis) {
  const double from = simulator_.now().lower();
  if (!(chord_basis_ == basis && chord_from_ == from)) {
    chord_basis_ = basis;
    chord_from_ = from;
    chord_ = sphere_chord(paths_, basis, from);
  }
  return chord_;
}

/// All beads but the newcomer are proved to stay.
template <Motion M, Kernel K, Radii radii>
bool WrappedHierarchy<M, K, radii>::is_proved(const Basis& basis, BeadId newcomer) {
  const SphereChord<dimension>& chord = chord_of(basis);
  if (!chord.proved) return false;
  for (std::size_t i = 0; i < basis.size; ++i) {
    if ((chord.stays >> i & 1U) == 0 && basis.beads[i] != newcomer) return false;
  }
  return true;
}

template <Motion M, Kernel K, Radii radii>
std::optional<Basis> WrappedHierarchy<M, K, radii>::proved_next_basis(const Basis& old, BeadId bead) {
  if (old.contains(bead)) {  // it is inside the sphere of its fellows now
    const Basis rest = without(old, bead);
    return is_proved(rest, no_bead) ? std::optional(rest) : std::nullopt;
  }
  // It is outside the sphere of the others now: where their coordinates are positive and all is proved that
  // a path proves, its own barycentric coordinate has the sign that says so.
  Basis next = old;
  if (old.size < full) {
    insert_bead(next, bead);
    return is_proved(next, bead) ? std::optional(next) : std::nullopt;
  }
  auto signs = signs_just_after();
  for (std::size_t place = 0; place < full; ++place) {
    next = old;
    erase_place(next, place);
    insert_bead(next, bead);
    if (is_proved(next, no_bead) && is_inside(next, old.beads[place], orientation_of(next, signs), signs))
      return next;
  }
  return std::nullopt;
}

template <Motion M, Kernel K, Radii radii>
bool WrappedHierarchy<M, K, radii>::repair(NodeId id, BeadId bead) {
  Basis& basis = nodes_[id].basis;
  std::array<BeadId, Basis::max_size + 1> all{};
  std::copy(basis.begin(), basis.end(), all.begin());
  std::size_t count = basis.size;
  const bool escaped = bead != no_bead && !basis.contains(bead);
  if (escaped) {
    std::size_t place = count++;
    for (; place > 0 && all[place - 1] > bead; --place) all[place] = all[place - 1];
    all[place] = bead;
  }
  const auto among = std::span(all).first(count);
  std::optional<Basis> next;
  if constexpr (prunes) {
    if (present_ && bead != no_bead && bead == present_bead_) next = proved_next_basis(basis, bead);
  }
  if (!next) next = basis_just_after(among, basis, escaped ? bead : no_bead);
  if (!next) {
    if constexpr (!std::same_as<K, Fast>) throw std::logic_error("no basis among beads " + bead_names(among));
    return false;
  }
  if (*next == basis) return false;
  basis = *next;
  return true;
}

template <Motion M, Kernel K, Radii radii>
void WrappedHierarchy<M, K, radii>::hold(NodeId id, Guard guard, unsigned table) {
  if (guard == Guard::violated) return;
  if (!has_slot(guard)) {
    ++nodes_[id].never_failing;
    return;
  }
  std::uint32_t place = 0;
  if (free_.empty()) {
    place = static_cast<std::uint32_t>(held_.size());
    held_.emplace_back();
  } else {
    place = free_.back();
    free_.pop_back();
  }
  held_[place] = {guard, nodes_[id].held, static_cast<std::uint8_t>(table)};
  nodes_[id].held = place;
}

template <Motion M, Kernel K, Radii radii>
void WrappedHierarchy<M, K, radii>::enqueue(NodeId id, const Basis& basis, BeadId bead, bool inside,
                                            int orientation) {
  visit_membership<radii>(
      motion_, std::span(basis.begin(), basis.end()), bead, inside, orientation, [&]<class C>(const C& c) {
        const bool own_root = present_ && c.identity() == present_->identity;
        if (own_root && c.side() == present_->side) failed_again_ = bead;
        tables_.template of<C>().enqueue(c, id,
                                         own_root || (std::same_as<K, Filtered> && has_present_root(c))
                                             ? Birth::at_own_root
                                             : Birth::unknown);
        watched_[Tables::template number_of<C>].push_back(bead);
        named_.insert(named_.end(), c.beads.begin(), c.beads.end());
      });
}

/// Guards the node by the certificates enqueued; the first bead whose certificate is violated or, unless
/// `zero_will_do`, zero for the whole step.
template <Motion M, Kernel K, Radii radii>
std::optional<BeadId> WrappedHierarchy<M, K, radii>::watch_enqueued(NodeId id, bool zero_will_do) {
  std::optional<BeadId> first = failed_again_;
  for (unsigned number = 1; number <= Tables::count; ++number) {
    if (watched_[number].empty()) continue;
    tables_.visit(number, [&](auto& table) {
      if (failed_again_) return table.forget_enqueued();
      std::size_t i = 0;
      table.watch_enqueued([&](NodeId, Guard guard) {
        if (!first && (guard == Guard::violated || (guard == Guard::zero && !zero_will_do)))
          first = watched_[number][i];
        hold(id, guard, number);
        ++i;
      });
    });
    watched_[number].clear();
  }
  failed_again_.reset();
  return first;
}

template <Motion M, Kernel K, Radii radii>
std::optional<BeadId> WrappedHierarchy<M, K, radii>::watch_node(NodeId id) {
  const Basis basis = nodes_[id].basis;
  named_.clear();
  // Beads that leave first: outside their proper domain the other certificates say nothing. Nor do they where
  // a bead is to spare all the time, its function zero. Two beads of one radius never part, but they may be
  // one all the time.
  bool parts = basis.size >= 2;
  if (radii == Radii::equal && basis.size == 2) {
    if (move_together(basis.beads[0], basis.beads[1])) return basis.beads[1];
    const BeadRange& range = tree_.range(id);
    if (range.last - range.first == 1) return std::nullopt;  // half of all nodes
    parts = false;
  }
  const unsigned stays = find_beads_to_watch(id);
  if (parts) {
    for (std::size_t i = 0; i < basis.size; ++i) {
      if ((stays >> i & 1U) == 0) enqueue(id, without(basis, basis.beads[i]), basis.beads[i], false, 0);
    }
    if (const auto to_spare = watch_enqueued(id, false)) return to_spare;
  }
  std::erase_if(beyond_, [&](BeadId b) { return basis.contains(b); });
  if (beyond_.empty()) return std::nullopt;
  auto signs = signs_just_after();
  const int orientation = orientation_of(basis, signs);
  for (const BeadId b : beyond_) enqueue(id, basis, b, true, orientation);
  return watch_enqueued(id, true);
}

/// Sets `beyond_`; a bit for each bead of the basis that is proved to stay in it.
template <Motion M, Kernel K, Radii radii>
unsigned WrappedHierarchy<M, K, radii>::find_beads_to_watch(NodeId id) {
  const BeadRange range = tree_.range(id);
  if constexpr (prunes) {
    const Basis& basis = nodes_[id].basis;
    const SphereChord<dimension>& chord = chord_of(basis);
    if (chord.proved) {
      find_beyond(paths_, range, basis.beads[0], chord, chord_from_, beyond_);
      return chord.stays;
    }
  }
  beyond_.resize(range.last - range.first + 1U);
  std::iota(beyond_.begin(), beyond_.end(), range.first);
  return 0;
}

template <Motion M, Kernel K, Radii radii>
void WrappedHierarchy<M, K, radii>::guard_node(NodeId id, Basis before) {
  for (int repairs = 0;; ++repairs) {
    const std::optional<BeadId> violated = watch_node(id);
    if (!violated) break;
    // `fast` lives with a contradiction until the next event of the node or the next step.
    if (std::same_as<K, Fast> && repairs >= most_repairs) break;
    drop_node(id);
    if (!repair(id, *violated)) {
      if constexpr (!std::same_as<K, Fast>) {
        throw std::logic_error(name_of(id) + ": a basis is violated and right at once, at bead " +
                               std::to_string(*violated));
      }
      ++statistics.rebuilds;
      break;
    }
  }
  if (!(nodes_[id].basis == before)) record(id, before);
}

template <Motion M, Kernel K, Radii radii>
void WrappedHierarchy<M, K, radii>::drop_node(NodeId id) {
  Node& node = nodes_[id];
  statistics.certificates.alive -= node.never_failing;
  node.never_failing = 0;
  for (std::uint32_t place = node.held; place != none; place = held_[place].next) {
    tables_.visit(held_[place].table, [&](auto& table) { table.drop(held_[place].guard); });
    free_.push_back(place);
  }
  node.held = none;
}

template <Motion M, Kernel K, Radii radii>
void WrappedHierarchy<M, K, radii>::fail(unsigned table, std::uint32_t slot) {
  NodeId id = 0;
  BeadId bead = 0;
  bool touch = false;
  tables_.visit(table, [&](auto& t) {
    const auto& certificate = t.certificate(slot);
    id = t.place_in_structure(slot);
    touch = t.touches(slot);
    if (touch) return;
    bead = present_bead_ = bead_of(certificate, nodes_[id].basis);
    present_ = Present{certificate.identity(), certificate.side(), {}};
    if constexpr (of_full_balls<std::remove_cvref_t<decltype(certificate)>>)
      present_->tangent = ascending(certificate);
  });
  for (std::uint32_t place = nodes_[id].held; place != none; place = held_[place].next) {
    Held& held = held_[place];
    if (held.table == table && held.guard == static_cast<Guard>(slot))
      held.guard = Guard::violated;  // gone already
  }
  drop_node(id);
  const Basis before = nodes_[id].basis;
  // A full basis may turn over without one of its beads leaving: where all meet, or where each touches the
  // sphere of the others. Then it stays and is guarded anew, for its certificates turn with it.
  bool repaired = true;
  if (!touch) {
    repaired = repair(id, bead);
  } else if (radii == Radii::any) {
    static_cast<void>(repair(id, no_bead));
  }
  if (!repaired && std::same_as<K, Fast>) {
    ++statistics.rebuilds;
    const double now = simulator_.now().upper();
    std::vector<double> wide = approximate_radii(motion_, now);
    for (double& r : wide) r = std::max(r, 0.0);  // it is rounded
    const BeadRange range = tree_.range(id);
    nodes_[id].basis = smallest_sphere(Balls(approximate_positions(motion_, now), wide), range.first,
                                       range.last, std::span(before.begin(), before.end()))
                           .basis;
  }
  present_bead_ = no_bead;  // what fails from here on is not known to be outside
  guard_node(id, before);
  present_.reset();
}

template <Motion M, Kernel K, Radii radii>
void WrappedHierarchy<M, K, radii>::record(NodeId id, const Basis& before) {
  const Basis& after = nodes_[id].basis;
  const auto misses = [](const Basis& basis, const Basis& of) {
    return std::any_of(of.begin(), of.end(), [&](BeadId b) { return !basis.contains(b); });
  };
  const bool entered = misses(before, after);
  const bool left = misses(after, before);
  Change change{entered && left ? pivot
                : entered       ? enter
                                : leave,
                static_cast<std::uint8_t>(2 + after.size),
                {tree_.range(id).first, tree_.range(id).last}};
  std::copy(after.begin(), after.end(), change.ids.begin() + 2);
  simulator_.record(index_, change);
}

template <Motion M, Kernel K, Radii radii>
void WrappedHierarchy<M, K, radii>::apply(const Change& change) {
  if (change.size < 3 || change.size > 2 + full)
    throw std::invalid_argument("a basis has one to " + std::to_string(full) + " beads");
  const auto node = tree_.find({change.ids[0], change.ids[1]});
  if (!node) throw std::invalid_argument("the hierarchy has no such node");
  if (!keeps(*node)) throw std::invalid_argument("the hierarchy does not keep this node");
  const Basis basis(std::span(change.ids).subspan(2, change.size - 2U));
  for (const BeadId b : basis) {
    if (b < change.ids[0] || b > change.ids[1])
      throw std::invalid_argument("a basis bead is not of its node");
  }
  if (std::adjacent_find(basis.begin(), basis.end()) != basis.end())
    throw std::invalid_argument("a basis bead stands twice");
  nodes_[*node].basis = basis;
}

template <Motion M, Kernel K, Radii radii>
std::vector<Basis> WrappedHierarchy<M, K, radii>::bases_at(const Dyadic& time) const {
  const WholeBalls<dimension> whole = whole_balls_at(motion_, time);
  std::vector<Basis> bases(nodes_.size());
  for (NodeId id = 0; id < nodes_.size(); ++id) {
    if (keeps(id)) bases[id] = proper_part(nodes_[id].basis, whole);
  }
  return bases;
}

/// The sphere of a basis that encloses all beads and has no bead to spare is the minimum enclosing one, and
/// the only one: checking both on integers is as good as building it. Nothing of it comes from certificates.
template <Motion M, Kernel K, Radii radii>
std::optional<std::string> WrappedHierarchy<M, K, radii>::audit(const Dyadic& time) {
  const WholeBalls<dimension> whole = whole_balls_at(motion_, time);
  for (NodeId id = 0; id < nodes_.size(); ++id) {
    if (!keeps(id)) continue;
    const Basis basis = proper_part(nodes_[id].basis, whole);
    const std::string where = name_of(id) + " with basis " +
                              bead_names(std::span(nodes_[id].basis.begin(), nodes_[id].basis.end()));
    if (const auto bead = bead_outside(basis, tree_.range(id), whole))
      return where + ": bead " + std::to_string(*bead) + " sticks out";
  }
  return std::nullopt;
}

}  // namespace kds
