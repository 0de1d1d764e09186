#pragma once
// Kinetic wrapped hierarchy: the certificates of a node.

#include "structures/hierarchy/wrapped_hierarchy.h"

namespace kds {

template <Motion M, Kernel K, Radii radii>
void WrappedHierarchy<M, K, radii>::hold(NodeId id, CertificateHandle guard, unsigned table) {
  if (guard == CertificateHandle::violated) return;
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

/// The first failure of a radical certificate, where the path of the sphere proves it. At its own root it is
/// known to hold just after now.
template <Motion M, Kernel K, Radii radii>
template <class C>
std::optional<Failure> WrappedHierarchy<M, K, radii>::crossing_of(const Basis& basis, BeadId bead,
                                                                  bool inside, bool at_own_root) {
  if constexpr (std::same_as<K, Filtered> && M::degree == 1 && radical_of_two_or_more<C>) {
    const Instant& now = simulator_.now();
    if (at_own_root && !now.isolating()) return std::nullopt;
    const auto failure =
        gap_roots_.first_failure(paths_, basis, bead, inside, now.lower(), now.upper(), at_own_root);
    if (failure) ++statistics.stages.isolation;
    return failure;
  }
  return std::nullopt;
}

template <Motion M, Kernel K, Radii radii>
void WrappedHierarchy<M, K, radii>::enqueue(NodeId id, const Basis& basis, BeadId bead, bool inside,
                                            int orientation) {
  visit_membership<radii>(
      motion_, std::span(basis.begin(), basis.end()), bead, inside, orientation, [&]<class C>(const C& c) {
        const bool own_root = present_ && c.identity() == present_->identity;
        if (own_root && c.side() == present_->side) failed_again_ = bead;
        const bool at_own_root = own_root || (std::same_as<K, Filtered> && has_present_root(c));
        if (const auto known = crossing_of<C>(basis, bead, inside, at_own_root)) {
          tables_.template of<C>().enqueue_known(c, id, *known);
        } else {
          tables_.template of<C>().enqueue(c, id,
                                           at_own_root ? KnownAtStart::at_own_root : KnownAtStart::unknown);
        }
        watched_[Tables::template number_of<C>].push_back(bead);
        for (const BeadId b : c.beads) named_.push_back({id, b});
      });
}

/// The basis beads that are not known to stay must leave no sphere of their fellows.
template <Motion M, Kernel K, Radii radii>
void WrappedHierarchy<M, K, radii>::enqueue_basis(NodeId id, unsigned stays) {
  const Basis& basis = nodes_[id].basis;
  if (basis.size < 2 || (radii == Radii::equal && basis.size == 2)) return;  // two of one radius never part
  for (std::size_t i = 0; i < basis.size; ++i) {
    if ((stays >> i & 1U) == 0) enqueue(id, without(basis, basis.beads[i]), basis.beads[i], false, 0);
  }
}

template <Motion M, Kernel K, Radii radii>
void WrappedHierarchy<M, K, radii>::enqueue_beyond(NodeId id, std::span<const BeadId> beyond) {
  if (beyond.empty()) return;
  auto signs = signs_just_after();
  const int orientation = orientation_of(nodes_[id].basis, signs);
  for (const BeadId b : beyond) enqueue(id, nodes_[id].basis, b, true, orientation);
}

/// Guards nodes by the certificates enqueued. Calls `report` with node and bead of each that is violated or,
/// unless `zero_will_do`, zero for the whole step.
template <Motion M, Kernel K, Radii radii>
template <class Report>
void WrappedHierarchy<M, K, radii>::watch_enqueued(bool zero_will_do, Report report) {
  for (unsigned number = 1; number <= Tables::count; ++number) {
    if (watched_[number].empty()) continue;
    tables_.visit(number, [&](auto& table) {
      std::size_t i = 0;
      table.watch_enqueued([&](NodeId id, CertificateHandle guard) {
        const BeadId bead = watched_[number][i++];
        if (guard == CertificateHandle::violated || (guard == CertificateHandle::zero && !zero_will_do))
          report(id, bead);
        hold(id, guard, number);
      });
    });
    watched_[number].clear();
  }
}

/// The same for one node: the first such bead, if any.
template <Motion M, Kernel K, Radii radii>
std::optional<BeadId> WrappedHierarchy<M, K, radii>::watch_enqueued(bool zero_will_do) {
  if (failed_again_) {
    for (unsigned number = 1; number <= Tables::count; ++number) {
      tables_.visit(number, [](auto& table) { table.forget_enqueued(); });
      watched_[number].clear();
    }
    return std::exchange(failed_again_, std::nullopt);
  }
  std::optional<BeadId> first;
  watch_enqueued(zero_will_do, [&](NodeId, BeadId bead) { first = first.value_or(bead); });
  return first;
}

template <Motion M, Kernel K, Radii radii>
std::optional<BeadId> WrappedHierarchy<M, K, radii>::watch_node(NodeId id) {
  named_.clear();
  if (is_one_bead(id)) return nodes_[id].basis.beads[1];
  if (is_lone_pair(id)) return std::nullopt;
  // Basis beads first: where one leaves the other certificates say nothing. Nor do they where a bead is to
  // spare all the time, its function zero.
  enqueue_basis(id, find_beads_to_watch(id));
  if (const auto to_spare = watch_enqueued(false)) return to_spare;
  take_out_later(id);
  enqueue_beyond(id, beyond_);
  return watch_enqueued(true);
}

template <Motion M, Kernel K, Radii radii>
void WrappedHierarchy<M, K, radii>::guard_node(NodeId id, Basis before) {
  for (int repairs = 0;; ++repairs) {
    const std::optional<BeadId> violated = watch_node(id);
    if (!violated) break;
    // `fast` lives with a contradiction until the next event of the node or the next step.
    if (std::same_as<K, Fast> && repairs >= most_repairs) break;
    drop_node(id);
    risen_ = no_bead;
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

}  // namespace kds
