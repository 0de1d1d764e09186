#include "structures/hierarchy/node_certificates.h"

#include <algorithm>
#include <utility>

#include "structures/enclosing_sphere/basis.h"

namespace kds {

namespace {

template <class Certificate, int Dimension>
inline constexpr bool radical_of_two_or_more = std::tuple_size_v<decltype(Certificate{}.beads)> >= 3 &&
                                               RadicalCertificateFor<Certificate, Curves<Dimension>>;

}  // namespace

// The simplex of a full basis may turn over when one of its certificates touches zero, so these touches are
// reported. Equal radii need no radical certificates.
template <int Dimension>
NodeCertificates<Dimension>::NodeCertificates(Simulator& simulator, KineticStructure& owner,
                                              std::size_t index, const MotionRef<Dimension>& motion,
                                              const Curves<Dimension>& curves, Radii radii, std::size_t nodes,
                                              NodeProofs<Dimension>& proofs)
    : simulator_(simulator),
      owner_(owner),
      curves_(curves),
      radii_(radii),
      proofs_(proofs),
      tables_(simulator, owner, index, motion,
              [radii]<class C>(std::type_identity<C>) -> std::optional<TouchPolicy> {
                if (radii == Radii::equal && RadicalCertificateFor<C, Curves<Dimension>>) return std::nullopt;
                return C{}.beads.size() == full ? TouchPolicy::reported : TouchPolicy::ignored;
              }),
      signs_(simulator, motion, curves, radii, tables_, owner.statistics.stages),
      held_by_(nodes),
      bead_count_(motion.bead_count()),
      per_bead_(owner.statistics.certificates, motion.bead_count()) {}

template <int Dimension>
void NodeCertificates<Dimension>::start_step() {
  std::fill(held_by_.begin(), held_by_.end(), HeldBy{});
  held_.clear();
  free_.clear();
  named_.clear();
  for (std::vector<BeadId>& beads : followed_) beads.clear();
  std::fill(named_by_.begin(), named_by_.end(), 0);
  risen_.clear();
}

template <int Dimension>
void NodeCertificates<Dimension>::hold(NodeId id, CertificateHandle handle, unsigned table) {
  if (handle == CertificateHandle::violated) return;
  HeldBy& by = held_by_[id];
  if (!has_slot(handle)) {
    ++by.never_failing;
    return;
  }
  std::uint32_t index = 0;
  if (free_.empty()) {
    index = static_cast<std::uint32_t>(held_.size());
    held_.emplace_back();
  } else {
    index = free_.back();
    free_.pop_back();
  }
  held_[index] = {handle, by.first, static_cast<std::uint8_t>(table)};
  by.first = index;
}

/// Returns the first failure of a radical certificate, if the path of the sphere proves it.
template <int Dimension>
template <class Certificate>
std::optional<Failure> NodeCertificates<Dimension>::crossing_of(const Basis& basis, BeadId bead, bool inside,
                                                                bool at_own_root) {
  if constexpr (radical_of_two_or_more<Certificate, Dimension>) {
    if (!proofs_.proves_crossings()) return std::nullopt;
    const auto failure = proofs_.crossing(basis, bead, inside, at_own_root);
    if (failure) ++owner_.statistics.stages.isolation;
    return failure;
  }
  return std::nullopt;
}

template <int Dimension>
void NodeCertificates<Dimension>::enqueue(NodeId id, const Basis& basis, BeadId bead, bool inside,
                                          int orientation) {
  const auto enqueue_it = [&]<class C>(const C& c) {
    const auto& present = signs_.present;
    const bool own_root = present && present->is_of(c);
    if (own_root && c.side() == present->side) failed_again_ = bead;
    const bool at_own_root =
        own_root || (simulator_.kernel() == Kernel::filtered && present && present->shares_root_with(c));
    if (const auto known = crossing_of<C>(basis, bead, inside, at_own_root)) {
      tables_.template of<C>().enqueue_known(c, id, *known);
    } else {
      tables_.template of<C>().enqueue(c, id,
                                       at_own_root ? KnownAtStart::at_own_root : KnownAtStart::unknown);
    }
    watched_[Tables::template number_of<C>].push_back(bead);
    for (const BeadId b : c.beads) named_.push_back({id, b});
    if (followed_.empty()) return;
    for (const BeadId b : c.beads) {
      followed_[id].push_back(b);
      ++named_by_[b];
      risen_.push_back(b);
    }
  };
  visit_membership(radii_, curves_, std::span(basis.begin(), basis.end()), bead, inside, orientation,
                   enqueue_it);
}

template <int Dimension>
void NodeCertificates<Dimension>::enqueue_basis(NodeId id, const Basis& basis, unsigned stays) {
  if (basis.size < 2 || (radii_ == Radii::equal && basis.size == 2)) return;  // the basis never shrinks
  for (std::size_t i = 0; i < basis.size; ++i) {
    if ((stays >> i & 1U) == 0) enqueue(id, without(basis, basis.beads[i]), basis.beads[i], false, 0);
  }
}

template <int Dimension>
void NodeCertificates<Dimension>::enqueue_beyond(NodeId id, const Basis& basis,
                                                 std::span<const BeadId> beyond) {
  if (beyond.empty()) return;
  const int orientation = orientation_of(basis, signs_);
  for (const BeadId b : beyond) enqueue(id, basis, b, true, orientation);
}

template <int Dimension>
std::span<const NamedBead> NodeCertificates<Dimension>::watch_enqueued(bool zero_will_do) {
  violated_.clear();
  for (unsigned number = 1; number <= Tables::count; ++number) {
    if (watched_[number].empty()) continue;
    tables_.visit(number, [&](auto& table) {
      std::size_t i = 0;
      table.watch_enqueued([&](NodeId id, CertificateHandle handle) {
        const BeadId bead = watched_[number][i++];
        if (handle == CertificateHandle::violated || (handle == CertificateHandle::zero && !zero_will_do))
          violated_.push_back({id, bead});
        hold(id, handle, number);
      });
    });
    watched_[number].clear();
  }
  return violated_;
}

template <int Dimension>
std::optional<BeadId> NodeCertificates<Dimension>::watch_enqueued_of_one(bool zero_will_do) {
  if (failed_again_) {
    for (unsigned number = 1; number <= Tables::count; ++number) {
      tables_.visit(number, [](auto& table) { table.forget_enqueued(); });
      watched_[number].clear();
    }
    return std::exchange(failed_again_, std::nullopt);
  }
  const auto violated = watch_enqueued(zero_will_do);
  return violated.empty() ? std::nullopt : std::optional(violated.front().bead);
}

template <int Dimension>
double NodeCertificates<Dimension>::certified_until(NodeId id) {
  double until = 1;
  for (std::uint32_t index = held_by_[id].first; index != none; index = held_[index].next) {
    tables_.visit(held_[index].table, [&](auto& table) {
      until = std::min(until, table.time(slot_of(held_[index].handle)).upper);
    });
  }
  return until;
}

template <int Dimension>
void NodeCertificates<Dimension>::drop(NodeId id) {
  forget_followed(id);
  HeldBy& by = held_by_[id];
  owner_.statistics.certificates.alive -= by.never_failing;
  by.never_failing = 0;
  for (std::uint32_t index = by.first; index != none; index = held_[index].next) {
    tables_.visit(held_[index].table, [&](auto& table) { table.drop(held_[index].handle); });
    free_.push_back(index);
  }
  by.first = none;
}

template <int Dimension>
typename NodeCertificates<Dimension>::Failed NodeCertificates<Dimension>::take_failed(
    unsigned table, std::uint32_t slot, std::span<const Basis> bases) {
  named_.clear();
  Failed failed;
  tables_.visit(table, [&](auto& t) {
    const auto& certificate = t.certificate(slot);
    failed.node = t.place_in_structure(slot);
    failed.touches = t.touches(slot);
    if (failed.touches) return;
    failed.bead = bead_of(certificate, bases[failed.node]);
    signs_.present.emplace(certificate);
  });
  for (std::uint32_t index = held_by_[failed.node].first; index != none; index = held_[index].next) {
    HeldCertificate& held = held_[index];
    if (held.table == table && held.handle == static_cast<CertificateHandle>(slot))
      held.handle = CertificateHandle::violated;  // removed already
  }
  drop(failed.node);
  return failed;
}

template <int Dimension>
void NodeCertificates<Dimension>::count_per_bead() {
  for (const NamedBead& one : named_) per_bead_.add(one.bead);
  for (const NamedBead& one : named_) per_bead_.reset(one.bead);
}

template <int Dimension>
void NodeCertificates<Dimension>::follow_names() {
  followed_.resize(held_by_.size());
  named_by_.resize(bead_count_);
}

template <int Dimension>
void NodeCertificates<Dimension>::count_followed() {
  auto& most = owner_.statistics.certificates.per_bead_max;
  for (const BeadId bead : risen_) most = std::max<std::uint64_t>(most, named_by_[bead]);
  risen_.clear();
}

template class NodeCertificates<2>;
template class NodeCertificates<3>;

}  // namespace kds
