#pragma once
// Kinetic wrapped hierarchy in space, equal radii: at every internal node of the balanced tree over a
// necklace the minimum enclosing sphere of all its beads, kept as a basis of at most four beads. Certificates
// of a node: each other bead stays inside the sphere of the basis; each basis bead stays outside the sphere
// of its fellows. Those that a bound on the sphere's path proves at once (sphere_chord.h) are not made. When
// one fails, the new basis is found among the basis and the bead, just after the event.

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "kds/certificate_table.h"
#include "motions/positions.h"
#include "motions/whole_view.h"
#include "structures/basis.h"
#include "structures/bead_names.h"
#include "structures/enclosing_sphere.h"
#include "structures/necklace_tree.h"
#include "structures/sphere_chord.h"

namespace kds {

template <Motion M, Kernel K>
class WrappedHierarchy final : public KineticStructure {
  static_assert(M::dimension == 3);

 public:
  WrappedHierarchy(Simulator& simulator, const M& motion, std::span<const BeadRange> necklaces)
      : simulator_(simulator),
        motion_(motion),
        tree_(necklaces),
        index_(simulator.add(*this)),
        of_singles_(simulator, *this, index_, 1, motion),
        of_pairs_(simulator, *this, index_, 2, motion),
        of_triples_(simulator, *this, index_, 3, motion, Touches::reported),
        of_quadruples_(simulator, *this, index_, 4, motion),
        nodes_(tree_.node_count()) {}

  enum Kind : std::uint8_t { enter, leave, pivot };

  [[nodiscard]] std::string_view name() const override { return "wrapped"; }
  /// Ids: the node's first and last bead, then its new basis.
  [[nodiscard]] std::span<const EventKind> kinds() const override {
    static constexpr std::array<EventKind, 3> kinds{{{"enter"}, {"leave"}, {"pivot"}}};
    return kinds;
  }

  [[nodiscard]] const NecklaceTree& tree() const { return tree_; }
  [[nodiscard]] const Basis& basis(NodeId node) const { return nodes_[node].basis; }

  void build() override;
  void start_step() override {
    for (Node& node : nodes_) {
      node.held = none;
      node.never_failing = 0;
    }
    held_.clear();
    free_.clear();
    if constexpr (prunes) ends_.set(motion_);
    per_bead_.assign(motion_.bead_count(), 0);
    for (NodeId node = 0; node < nodes_.size(); ++node) {
      guard_node(node, nodes_[node].basis);
      for (const BeadId b : named_) ++per_bead_[b];
    }
    const auto most = std::max_element(per_bead_.begin(), per_bead_.end());
    auto& per_bead_max = statistics.certificates.per_bead_max;
    if (most != per_bead_.end()) per_bead_max = std::max(per_bead_max, *most);
  }
  void fail(unsigned table, std::uint32_t slot) override;
  void apply(const Change& change) override;
  [[nodiscard]] std::optional<std::string> audit(const Dyadic& time) override;

  /// The bases at a frame, none with a bead to spare even where the frame is degenerate.
  [[nodiscard]] Basis basis_at(NodeId node, const Dyadic& time) const;

 private:
  static constexpr std::uint32_t none = 0xffffffffU;
  static constexpr int most_repairs = 64;  // of one node at one time, in `fast`
  /// Doubles prove some certificates without looking at them one by one.
  static constexpr bool prunes = M::degree == 1 && !std::same_as<K, Exact>;

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

  /// The sign of a certificate just after now. That of the failing one is known, and so is its function's
  /// elsewhere.
  struct JustAfter {
    WrappedHierarchy& self;
    template <class Certificate>
    int operator()(const Certificate& c) const {
      if (self.present_ && c.identity() == self.present_->identity) {
        return c.side() == self.present_->side ? -1 : 1;
      }
      return sign_just_after<K>(c, self.motion_, self.simulator_.now(), self.statistics.stages);
    }
  };
  struct AtTime {
    const M& motion;
    const Dyadic& time;
    template <class Certificate>
    int operator()(const Certificate& c) const {
      return function_of(c, MomentView<M>(motion, c.beads, time)).scaled[0].sign();
    }
  };
  struct Present {
    Identity identity;
    bool side;  // which side of zero its certificate wants
  };

  /// The bead that a certificate of a node with this basis is about.
  template <int Size>
  static BeadId bead_of(const BeadInSphere<Size>& c, const Basis&) {
    return c.beads[Size];
  }
  static BeadId bead_of(const PowerTest<3>& c, const Basis& basis) {
    return *std::find_if(c.beads.begin(), c.beads.end(), [&](BeadId b) { return !basis.contains(b); });
  }

  auto& table_of(const BeadInSphere<1>&) { return of_singles_; }
  auto& table_of(const BeadInSphere<2>&) { return of_pairs_; }
  auto& table_of(const BeadInSphere<3>&) { return of_triples_; }
  auto& table_of(const PowerTest<3>&) { return of_quadruples_; }
  template <class Visit>
  void visit_table(unsigned table, Visit&& visit) {
    switch (table) {
      case 1:
        return visit(of_singles_);
      case 2:
        return visit(of_pairs_);
      case 3:
        return visit(of_triples_);
      default:
        return visit(of_quadruples_);
    }
  }

  [[nodiscard]] bool move_together(BeadId a, BeadId b) const {
    for (int k = 0; k <= M::degree; ++k) {
      for (int axis = 0; axis < M::dimension; ++axis) {
        if (motion_.coordinate(a, k, axis) != motion_.coordinate(b, k, axis)) return false;
      }
    }
    return true;
  }
  /// Guards a node, repairing its basis while a certificate is violated already; logs the change from
  /// `before`.
  void guard_node(NodeId node, Basis before);
  [[nodiscard]] bool find_beads_to_watch(NodeId node);
  /// Guards the node's present basis; the first bead whose certificate is violated, if any.
  [[nodiscard]] std::optional<BeadId> watch_node(NodeId node);
  [[nodiscard]] std::optional<BeadId> watch_all_of(NodeId node, unsigned table, bool zero_will_do);
  void hold(NodeId node, Guard guard, unsigned table);
  void drop_node(NodeId node);
  /// The basis of the node's basis and `bead`, which escaped or is to spare.
  [[nodiscard]] bool repair(NodeId node, BeadId bead);
  void record(NodeId node, const Basis& before);

  Simulator& simulator_;
  const M& motion_;
  NecklaceTree tree_;
  std::size_t index_;
  // Tables are numbered by the size of the basis.
  CertificateTable<BeadInSphere<1>, M, K> of_singles_;
  CertificateTable<BeadInSphere<2>, M, K> of_pairs_;
  CertificateTable<BeadInSphere<3>, M, K> of_triples_;
  CertificateTable<PowerTest<3>, M, K> of_quadruples_;
  std::vector<Node> nodes_;
  std::vector<Held> held_;
  std::vector<std::uint32_t> free_;
  std::vector<BeadId> watched_;  // of the certificates that are enqueued
  StepEnds ends_;
  std::vector<BeadId> beyond_;           // beads of a node that are not proved to stay inside
  std::vector<BeadId> named_;            // by the certificates of the node watched last
  std::vector<std::uint64_t> per_bead_;  // certificates that name it, at the start of a step
  std::optional<Present> present_;
};

template <Motion M, Kernel K>
void WrappedHierarchy<M, K>::build() {
  const Eigen::Matrix3Xd centers = control_points(motion_, 0);
  JustAfter decide{*this};
  for (NodeId id = 0; id < nodes_.size(); ++id) {
    const BeadRange range = tree_.range(id);
    nodes_[id].basis =
        likely_basis(range.first, range.last, Basis(std::array{range.first, range.last}), centers);
    // Verified, and put right where double was wrong, for the moment after the start.
    bool settled = false;
    for (int i = 0; !settled && (i < most_repairs || !std::same_as<K, Fast>); ++i) {
      settled = true;
      if (!is_proper(nodes_[id].basis, decide)) {
        settled = !repair(id, no_bead);
        continue;
      }
      const int orientation = orientation_of(nodes_[id].basis, decide);
      for (BeadId b = range.first; b <= range.last; ++b) {
        if (nodes_[id].basis.contains(b) || is_inside(nodes_[id].basis, b, orientation, decide)) continue;
        settled = !repair(id, b);
        break;
      }
    }
  }
}

template <Motion M, Kernel K>
bool WrappedHierarchy<M, K>::repair(NodeId id, BeadId bead) {
  Basis& basis = nodes_[id].basis;
  std::array<BeadId, Basis::max_size + 1> among{};
  std::size_t count = basis.size;
  std::copy(basis.begin(), basis.end(), among.begin());
  BasisHint hint{std::max<std::size_t>(1, basis.size - 1U)};
  if (bead != no_bead && !basis.contains(bead)) {
    among[count++] = bead;
    hint = {basis.size, bead};  // it is outside the sphere of all the others
  }
  JustAfter decide{*this};
  auto next = basis_among(std::span(among).first(count), decide, hint);
  if (!next && hint.member != no_bead) next = basis_among(std::span(among).first(count), decide);
  if (!next) {
    if constexpr (!std::same_as<K, Fast>)
      throw std::logic_error("no basis among beads " + bead_names(std::span(among).first(count)));
    return false;
  }
  if (*next == basis) return false;
  basis = *next;
  return true;
}

template <Motion M, Kernel K>
void WrappedHierarchy<M, K>::hold(NodeId id, Guard guard, unsigned table) {
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

/// Guards the node by the certificates of these beads against their bases; the first bead whose certificate
/// is violated or, unless `zero_will_do`, zero for the whole step.
template <Motion M, Kernel K>
std::optional<BeadId> WrappedHierarchy<M, K>::watch_all_of(NodeId id, unsigned table, bool zero_will_do) {
  std::optional<BeadId> first;
  visit_table(table, [&](auto& t) {
    std::size_t i = 0;
    t.watch_enqueued([&](NodeId, Guard guard) {
      if (!first && (guard == Guard::violated || (guard == Guard::zero && !zero_will_do)))
        first = watched_[i];
      hold(id, guard, table);
      ++i;
    });
  });
  watched_.clear();
  return first;
}

template <Motion M, Kernel K>
std::optional<BeadId> WrappedHierarchy<M, K>::watch_node(NodeId id) {
  const Basis basis = nodes_[id].basis;
  JustAfter decide{*this};
  named_.clear();
  // The bead whose certificate has just failed and would be watched again, if any.
  std::optional<BeadId> failed;
  const auto enqueue = [&](BeadId bead) {
    return [this, id, bead, &failed](const auto& c) {
      const bool own_root = present_ && c.identity() == present_->identity;
      if (own_root && c.side() == present_->side) failed = bead;
      table_of(c).enqueue(c, id, own_root ? Birth::at_own_root : Birth::unknown);
      watched_.push_back(bead);
      named_.insert(named_.end(), c.beads.begin(), c.beads.end());
    };
  };
  const auto watch = [&](unsigned table, bool zero_will_do) -> std::optional<BeadId> {
    if (!failed) return watch_all_of(id, table, zero_will_do);
    visit_table(table, [](auto& t) { t.forget_enqueued(); });
    watched_.clear();
    return failed;
  };
  // Beads that leave first: outside their proper domain the other certificates say nothing. Nor do they where
  // a bead is to spare all the time, its function zero. Two beads never part, but they may be one all the
  // time.
  if (basis.size == 2 && move_together(basis.beads[0], basis.beads[1])) return basis.beads[1];
  const bool keeps_basis = find_beads_to_watch(id);
  if (basis.size >= 3 && !keeps_basis) {
    for (const BeadId b : basis) visit_membership(without(basis, b), b, false, 0, enqueue(b));
    if (const auto to_spare = watch(basis.size - 1U, false)) return to_spare;
  }
  std::erase_if(beyond_, [&](BeadId b) { return basis.contains(b); });
  if (beyond_.empty()) return std::nullopt;
  const int orientation = orientation_of(basis, decide);
  for (const BeadId b : beyond_) visit_membership(basis, b, true, orientation, enqueue(b));
  return watch(basis.size, true);
}

/// Sets `beyond_`; whether the basis' own beads are proved to stay in it.
template <Motion M, Kernel K>
bool WrappedHierarchy<M, K>::find_beads_to_watch(NodeId id) {
  const Basis& basis = nodes_[id].basis;
  const BeadRange range = tree_.range(id);
  if constexpr (prunes) {
    const double from = simulator_.now().lower();
    const SphereChord chord = sphere_chord(ends_, basis, from);
    if (chord.proved) {
      find_beyond(ends_, range, basis.beads[0], chord, from, beyond_);
      return chord.keeps_basis;
    }
  }
  beyond_.resize(range.last - range.first + 1U);
  std::iota(beyond_.begin(), beyond_.end(), range.first);
  return false;
}

template <Motion M, Kernel K>
void WrappedHierarchy<M, K>::guard_node(NodeId id, Basis before) {
  for (int repairs = 0;; ++repairs) {
    const std::optional<BeadId> violated = watch_node(id);
    if (!violated) break;
    // `fast` lives with a contradiction until the next event of the node or the next step.
    if (std::same_as<K, Fast> && repairs >= most_repairs) break;
    drop_node(id);
    if (!repair(id, *violated)) {
      if constexpr (!std::same_as<K, Fast>) {
        throw std::logic_error("a basis is violated and right at once, at bead " + std::to_string(*violated));
      }
      ++statistics.rebuilds;
      break;
    }
  }
  if (!(nodes_[id].basis == before)) record(id, before);
}

template <Motion M, Kernel K>
void WrappedHierarchy<M, K>::drop_node(NodeId id) {
  Node& node = nodes_[id];
  of_pairs_.drop_never(node.never_failing);
  node.never_failing = 0;
  for (std::uint32_t place = node.held; place != none; place = held_[place].next) {
    visit_table(held_[place].table, [&](auto& table) { table.drop(held_[place].guard); });
    free_.push_back(place);
  }
  node.held = none;
}

template <Motion M, Kernel K>
void WrappedHierarchy<M, K>::fail(unsigned table, std::uint32_t slot) {
  NodeId id = 0;
  BeadId bead = 0;
  bool touch = false;
  visit_table(table, [&](auto& t) {
    const auto& certificate = t.certificate(slot);
    id = t.place_in_structure(slot);
    touch = t.touches(slot);
    if (touch) return;
    bead = bead_of(certificate, nodes_[id].basis);
    present_ = Present{certificate.identity(), certificate.side()};
  });
  for (std::uint32_t place = nodes_[id].held; place != none; place = held_[place].next) {
    Held& held = held_[place];
    if (held.table == table && held.guard == static_cast<Guard>(slot))
      held.guard = Guard::violated;  // gone already
  }
  drop_node(id);
  const Basis before = nodes_[id].basis;
  // A basis of four may turn over without one of its beads leaving: where all meet, or where each touches the
  // sphere of the others. Then it stays and is guarded anew, for the power tests turn with it.
  if (!touch && !repair(id, bead) && std::same_as<K, Fast>) {
    ++statistics.rebuilds;
    const BeadRange range = tree_.range(id);
    nodes_[id].basis = likely_basis(range.first, range.last, before,
                                    approximate_positions(motion_, simulator_.now().upper()));
  }
  guard_node(id, before);
  present_.reset();
}

template <Motion M, Kernel K>
void WrappedHierarchy<M, K>::record(NodeId id, const Basis& before) {
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

template <Motion M, Kernel K>
void WrappedHierarchy<M, K>::apply(const Change& change) {
  if (change.size < 3 || change.size > 2 + Basis::max_size)
    throw std::invalid_argument("a basis has one to four beads");
  const auto node = tree_.find({change.ids[0], change.ids[1]});
  if (!node) throw std::invalid_argument("the hierarchy has no such node");
  const Basis basis(std::span(change.ids).subspan(2, change.size - 2U));
  for (const BeadId b : basis) {
    if (b < change.ids[0] || b > change.ids[1])
      throw std::invalid_argument("a basis bead is not of its node");
  }
  nodes_[*node].basis = basis;
}

template <Motion M, Kernel K>
Basis WrappedHierarchy<M, K>::basis_at(NodeId id, const Dyadic& time) const {
  const Basis& basis = nodes_[id].basis;
  AtTime decide{motion_, time};
  if (is_proper(basis, decide)) return basis;
  return basis_among(std::span(basis.beads).first(basis.size), decide).value_or(basis);
}

/// The sphere of a basis that encloses all beads and has no bead to spare is the minimum enclosing one, and
/// the only one: checking both on integers is as good as building it.
template <Motion M, Kernel K>
std::optional<std::string> WrappedHierarchy<M, K>::audit(const Dyadic& time) {
  AtTime decide{motion_, time};
  for (NodeId id = 0; id < nodes_.size(); ++id) {
    const Basis basis = basis_at(id, time);
    const BeadRange range = tree_.range(id);
    const std::string where = "node " + std::to_string(range.first) + "-" + std::to_string(range.last) +
                              " with basis " + bead_names(std::span(basis.beads).first(basis.size));
    if (!is_proper(basis, decide)) return where + ": a basis bead is to spare";
    const int orientation = orientation_of(basis, decide);
    for (BeadId b = range.first; b <= range.last; ++b) {
      if (!basis.contains(b) && !is_inside(basis, b, orientation, decide))
        return where + ": bead " + std::to_string(b) + " sticks out";
    }
  }
  return std::nullopt;
}

}  // namespace kds
