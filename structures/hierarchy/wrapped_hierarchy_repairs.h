#pragma once
// Kinetic wrapped hierarchy: the next basis of a node, when one of its certificates has failed.

#include "structures/hierarchy/wrapped_hierarchy.h"

namespace kds {

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
std::optional<Basis> WrappedHierarchy<M, K, radii>::proved_next_basis(const Basis& old, BeadId bead) {
  if (old.contains(bead)) {  // it is inside the sphere of its fellows now
    const Basis rest = without(old, bead);
    return are_proved({&rest, 1}, no_bead) == 0 ? std::nullopt : std::optional(rest);
  }
  // It is outside the sphere of the others now: where their coordinates are positive and all is proved that
  // a path proves, its own barycentric coordinate has the sign that says so.
  std::array<Basis, full> next;
  if (old.size < full) {
    next[0] = old;
    insert_bead(next[0], bead);
    return are_proved({next.data(), 1}, bead) == 0 ? std::nullopt : std::optional(next[0]);
  }
  for (std::size_t place = 0; place < full; ++place) {
    next[place] = old;
    erase_place(next[place], place);
    insert_bead(next[place], bead);
  }
  const unsigned proved = are_proved(next, no_bead);
  auto signs = signs_just_after();
  for (std::size_t place = 0; place < full; ++place) {
    if ((proved >> place & 1U) != 0 &&
        is_inside(next[place], old.beads[place], orientation_of(next[place], signs), signs))
      return next[place];
  }
  return std::nullopt;
}

template <Motion M, Kernel K, Radii radii>
bool WrappedHierarchy<M, K, radii>::repair(NodeId id, BeadId bead) {
  resting_.forget(id);
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
BeadId WrappedHierarchy<M, K, radii>::risen_bead(const Basis& old, const Basis& next, BeadId failed) const {
  if (!prunes || !simulator_.now().isolating()) return no_bead;
  std::array<BeadId, Basis::max_size> gone{};
  std::size_t count = 0;
  for (const BeadId b : old)
    if (!next.contains(b)) gone[count++] = b;
  if (old.contains(failed)) return count == 1 && gone[0] == failed ? failed : no_bead;
  if (!next.contains(failed)) return no_bead;
  if (count == 0) return failed;
  return count == 1 && old.size == full ? gone[0] : no_bead;
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
    present_ = PresentFailure{certificate.identity(), certificate.side(), {}};
    if constexpr (of_full_balls<std::remove_cvref_t<decltype(certificate)>>) present_->of_full = certificate;
  });
  for (std::uint32_t place = nodes_[id].held; place != none; place = held_[place].next) {
    HeldCertificate& held = held_[place];
    if (held.table == table && held.guard == static_cast<CertificateHandle>(slot))
      held.guard = CertificateHandle::violated;  // gone already
  }
  drop_node(id);
  const Basis before = nodes_[id].basis;
  // A full basis may turn over without one of its beads leaving: where all meet, or where each touches the
  // sphere of the others. Then it stays and is guarded anew, for its certificates turn with it.
  bool repaired = true;
  if (!touch) {
    repaired = repair(id, bead);
    risen_ = risen_bead(before, nodes_[id].basis, bead);
  } else if (radii == Radii::any) {
    static_cast<void>(repair(id, no_bead));
  }
  if (!repaired && std::same_as<K, Fast>) {
    ++statistics.rebuilds;
    const double now = simulator_.now().upper();
    std::vector<double> wide = approximate_radii(motion_, now);
    for (double& r : wide) r = std::max(r, 0.0);  // it is rounded
    const BeadRange range = tree_.range(id);
    resting_.forget(id);
    nodes_[id].basis = smallest_sphere(Balls(approximate_positions(motion_, now), wide), range.first,
                                       range.last, std::span(before.begin(), before.end()))
                           .basis;
  }
  present_bead_ = no_bead;  // what fails from here on is not known to be outside
  guard_node(id, before);
  risen_ = no_bead;
  present_.reset();
}

template <Motion M, Kernel K, Radii radii>
void WrappedHierarchy<M, K, radii>::record(NodeId id, const Basis& before) {
  const Basis& after = nodes_[id].basis;
  const auto misses = [](const Basis& basis, const Basis& of) {
    bool any = false;
    for (const BeadId b : of) any |= !basis.contains(b);
    return any;
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

}  // namespace kds
