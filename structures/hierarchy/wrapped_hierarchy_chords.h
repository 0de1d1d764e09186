#pragma once
// Kinetic wrapped hierarchy: what the paths of spheres prove, so that no certificate is needed.

#include "structures/hierarchy/wrapped_hierarchy.h"

namespace kds {

template <Motion M, Kernel K, Radii radii>
void WrappedHierarchy<M, K, radii>::find_doubtful_nodes() {
  doubtful_.clear();
  all_beyond_.clear();
  if constexpr (!prunes) {
    for (const NodeId id : guarded_) doubtful_.push_back({id, {}, 0});
    return;
  }
  struct Waiting {
    std::array<NodeId, Lanes::width> nodes;
    std::array<BeadRange, Lanes::width> ranges;
    std::array<Basis, Lanes::width> bases;
    std::size_t count = 0;
  };
  std::array<Waiting, full + 1> of_size;
  ChordFilterResult<dimension> look;
  const auto look_at = [&](Waiting& w) {
    filter_nodes<dimension>(paths_, std::span(w.ranges).first(w.count), std::span(w.bases).first(w.count),
                            look, all_beyond_);
    for (std::size_t i = 0; i < w.count; ++i)
      if (!look.steady[i]) doubtful_.push_back({w.nodes[i], look.chords[i], look.ends[i]});
    w.count = 0;
  };
  for (const NodeId id : guarded_) {
    Waiting& w = of_size[nodes_[id].basis.size];
    w.nodes[w.count] = id;
    w.ranges[w.count] = tree_.range(id);
    w.bases[w.count] = nodes_[id].basis;
    if (++w.count == Lanes::width) look_at(w);
  }
  for (Waiting& w : of_size)
    if (w.count > 0) look_at(w);
}

/// Sets `beyond_` to what is not proved to stay inside; a bit for each bead of the basis that is proved to
/// stay in it.
template <Motion M, Kernel K, Radii radii>
unsigned WrappedHierarchy<M, K, radii>::find_beads_to_watch(NodeId id) {
  const BeadRange range = tree_.range(id);
  const Basis& basis = nodes_[id].basis;
  const Period rest = rest_of_step();
  const SphereChord<dimension>* chord = nullptr;
  if constexpr (prunes) {
    chord = &chord_cache_.of(paths_, basis, rest);
    if (chord->proved) find_beyond(paths_, range, basis, *chord, rest.from, beyond_);
  }
  return take_out_staying(id, chord, rest);
}

/// Takes out of `beyond_` what more than the chord alone proves to stay inside; the same bits. Where no chord
/// is proved it sets `beyond_` first.
template <Motion M, Kernel K, Radii radii>
unsigned WrappedHierarchy<M, K, radii>::take_out_staying(NodeId id, const SphereChord<dimension>* chord,
                                                         const Period& rest) {
  const Basis& basis = nodes_[id].basis;
  if (chord == nullptr || !chord->proved) {
    const BeadRange range = tree_.range(id);
    beyond_.clear();
    for (BeadId b = range.first; b <= range.last; ++b)
      if (!basis.contains(b)) beyond_.push_back(b);
    return prunes ? look_closely(basis, 1) : 0;
  }
  const bool never_again = radii == Radii::equal && risen_ != no_bead && simulator_.now().last();
  if (never_again) std::erase(beyond_, risen_);
  if (!beyond_.empty()) take_out_dipping(paths_, basis, *chord, rest, risen_, beyond_);
  unsigned stays = chord->stays;
  for (std::size_t place = 0; place < basis.size; ++place)
    if (basis.beads[place] == risen_) stays |= (never_again ? ~0U : chord->rises) & (1U << place);
  const std::size_t unproved =
      beyond_.size() + static_cast<std::size_t>(std::popcount(all_of(basis) & ~stays));
  return unproved < few ? stays : stays | look_closely(basis, 1);
}

/// The same by the sphere's chords in the quarters of the time until then: a sixteenth as far from it.
template <Motion M, Kernel K, Radii radii>
unsigned WrappedHierarchy<M, K, radii>::look_closely(const Basis& basis, double until) {
  constexpr std::size_t parts = Lanes::width;
  const double from = simulator_.now().lower();
  std::array<Period, parts> periods;
  std::array<Basis, parts> bases;
  std::array<SphereChord<dimension>, parts> chords;
  bases.fill(basis);
  for (std::size_t i = 0; i < parts; ++i) {
    periods[i].from = i == 0 ? from : periods[i - 1].to;
    periods[i].to = i + 1 == parts ? until : from + 0.25 * static_cast<double>(i + 1) * (until - from);
  }
  sphere_chords<dimension>(paths_, bases, periods, chords);
  unsigned stays = all_of(basis);
  for (const auto& chord : chords) {
    if (!chord.proved) return 0;
    stays &= chord.stays;
  }
  keep_beyond<dimension>(paths_, basis, chords, periods, beyond_);
  return stays;
}

template <Motion M, Kernel K, Radii radii>
double WrappedHierarchy<M, K, radii>::guarded_until(NodeId id) {
  double until = 1;
  for (std::uint32_t place = nodes_[id].held; place != none; place = held_[place].next) {
    tables_.visit(held_[place].table, [&](auto& table) {
      until = std::min(until, table.time(slot_of(held_[place].guard)).upper);
    });
  }
  return until;
}

/// The first failure of any certificate of the node makes all of them anew.
template <Motion M, Kernel K, Radii radii>
void WrappedHierarchy<M, K, radii>::take_out_later(NodeId id) {
  if constexpr (!prunes) return;
  if (beyond_.size() < worth_another_look || nodes_[id].held == none) return;
  static_cast<void>(look_closely(nodes_[id].basis, guarded_until(id)));
}

/// A bit for each of up to four that is proved to be the basis of its beads just after now, if the newcomer
/// does not have to be. Of one alone the chord is known then.
template <Motion M, Kernel K, Radii radii>
unsigned WrappedHierarchy<M, K, radii>::are_proved(std::span<const Basis> bases, BeadId newcomer) {
  const double from = simulator_.now().lower();
  Period soon{from, from + 0x1p-16 * (1 - from)};
  if (!(soon.to > simulator_.now().upper())) soon.to = 1;
  std::array<Basis, Lanes::width> asked;
  std::array<Period, Lanes::width> periods;
  std::array<SphereChord<dimension>, Lanes::width> chords;
  asked.fill(bases.front());
  std::copy(bases.begin(), bases.end(), asked.begin());
  periods.fill(soon);
  const bool alone = bases.size() == 1;
  if (alone) periods[1] = rest_of_step();
  sphere_chords<dimension>(paths_, asked, periods, chords);
  if (alone) chord_cache_.keep(bases.front(), periods[1], chords[1]);
  unsigned proved = 0;
  for (std::size_t i = 0; i < bases.size(); ++i) {
    unsigned stay = chords[i].stays;
    for (std::size_t place = 0; place < bases[i].size; ++place)
      if (bases[i].beads[place] == newcomer) stay |= 1U << place;
    if (chords[i].proved && stay == all_of(bases[i])) proved |= 1U << i;
  }
  return proved;
}

}  // namespace kds
