#include "structures/hierarchy/node_proofs.h"

#include <algorithm>
#include <array>
#include <bit>

#include "motions/numbers/lanes.h"
#include "structures/enclosing_sphere/basis.h"
#include "structures/enclosing_sphere/enclosing_sphere.h"
#include "structures/moving_sphere/beads_beyond.h"

namespace kds {

template <int Dimension>
NodeProofs<Dimension>::NodeProofs(const Simulator& simulator, const NecklaceTree& tree,
                                  const Curves<Dimension>& curves, int degree, Radii radii,
                                  const Relaxation& relaxation)
    : simulator_(simulator),
      tree_(tree),
      curves_(curves),
      radii_(radii),
      any_(simulator.kernel() != Kernel::exact && degree >= 1 && degree <= BeadPaths<Dimension>::most_degree),
      proves_crossings_(any_ && simulator.kernel() == Kernel::filtered && degree == 1),
      enlarged_by_(radii == Radii::equal ? 1 + relaxation.share() : 1),
      relaxed_allowance_(radii == Radii::any ? relaxation : Relaxation{}),
      slack_(tree) {}

template <int Dimension>
void NodeProofs<Dimension>::take_curves() {
  if (!any_) return;
  paths_.set(curves_, radii_ == Radii::equal);
  relaxed_allowance_.start_step(curves_);
  gap_roots_.forget();
  chord_cache_.forget();
}

// A pair of balls needs a guard if neither holds the other. A pair of beads of equal radius needs one if
// their centres differ.
template <int Dimension>
void NodeProofs<Dimension>::add_unsettled(std::span<const NodeId> pairs, std::span<const Basis> bases,
                                          std::vector<NodeId>& nodes) {
  const auto add_those = [&](auto are_apart) {
    std::size_t count = nodes.size();
    nodes.resize(count + pairs.size());
    for (const NodeId id : pairs) {  // no branch, because settled nodes are unpredictable
      const bool apart = are_apart(tree_.range(id).first);
      const bool settled = (bases[id].size == 2) & apart;
      nodes[count] = id;
      count += settled ? 0 : 1;
    }
    nodes.resize(count);
  };
  if (radii_ == Radii::any) {
    if (any_) {
      paths_.find_apart_from_next(apart_from_next_);
      add_those([this](BeadId b) { return apart_from_next_[b] != 0; });
    } else {
      add_those([](BeadId) { return false; });
    }
  } else if (any_) {
    const double* const x = paths_.column(0, 0);
    add_those([x](BeadId b) { return x[b] != x[b + 1]; });
  } else {
    add_those([this](BeadId b) { return curves_.coordinate(b, 0, 0) != curves_.coordinate(b + 1, 0, 0); });
  }
}

template <int Dimension>
void NodeProofs<Dimension>::take_out_resting(std::span<const Basis> bases, std::vector<NodeId>& nodes) {
  if (any_) slack_.take_out_resting(paths_, bases, nodes);
}

template <int Dimension>
void NodeProofs<Dimension>::find_candidates(std::span<const NodeId> nodes, std::span<const Basis> bases) {
  candidates_.clear();
  beyond_.clear();
  if (!any_) {
    for (const NodeId id : nodes) candidates_.push_back({id, {}, 0});
    return;
  }
  struct Waiting {
    std::array<NodeId, Lanes::width> nodes;
    std::array<BeadRange, Lanes::width> ranges;
    std::array<Basis, Lanes::width> bases;
    std::array<double, Lanes::width> raised_by;
    std::size_t count = 0;
  };
  std::array<Waiting, full + 1> of_size;
  ChordFilterResult<Dimension> look;
  const auto look_at = [&](Waiting& w) {
    filter_nodes<Dimension>(paths_, std::span(w.ranges).first(w.count), std::span(w.bases).first(w.count),
                            look, beyond_, enlarged_by_,
                            std::span(w.raised_by).first(relaxed_allowance_.any() ? w.count : 0));
    for (std::size_t i = 0; i < w.count; ++i)
      if (!look.steady[i]) candidates_.push_back({w.nodes[i], look.chords[i], look.ends[i]});
    w.count = 0;
  };
  for (const NodeId id : nodes) {
    Waiting& w = of_size[bases[id].size];
    w.nodes[w.count] = id;
    w.ranges[w.count] = tree_.range(id);
    w.bases[w.count] = bases[id];
    if (relaxed_allowance_.any()) w.raised_by[w.count] = relaxed_allowance_.of(curves_, bases[id]);
    if (++w.count == Lanes::width) look_at(w);
  }
  for (Waiting& w : of_size)
    if (w.count > 0) look_at(w);
}

template <int Dimension>
bool NodeProofs<Dimension>::is_proper_at_start(const Basis& basis) const {
  std::array<std::array<double, Dimension>, full> centers;
  std::array<double, full> own_radii;
  for (std::size_t i = 0; i < basis.size; ++i) {
    for (int axis = 0; axis < Dimension; ++axis)
      centers[i][static_cast<std::size_t>(axis)] = curves_.coordinate(basis.beads[i], 0, axis);
    own_radii[i] = curves_.radius(basis.beads[i], 0);
  }
  return is_certainly_proper<Dimension>(std::span(centers).first(basis.size),
                                        std::span(own_radii).first(basis.size));
}

template <int Dimension>
unsigned NodeProofs<Dimension>::take_out_staying(const Basis& basis, const BeadRange& range,
                                                 const SphereChord<Dimension>& chord,
                                                 std::vector<BeadId>& beyond) {
  return take_out_staying(basis, range, &chord, {}, no_bead, beyond);
}

template <int Dimension>
unsigned NodeProofs<Dimension>::find_beads_to_watch(const Basis& basis, const BeadRange& range, BeadId risen,
                                                    std::vector<BeadId>& beyond) {
  const Period rest = rest_of_step();
  const SphereChord<Dimension>* chord = nullptr;
  if (any_) {
    chord = &chord_cache_.of(paths_, basis, rest,
                             [this](const Basis& of, SphereChord<Dimension>& one) { relax(of, one); });
    if (chord->proved) find_beyond(paths_, range, basis, *chord, rest.from, beyond);
  }
  return take_out_staying(basis, range, chord, rest, risen, beyond);
}

template <int Dimension>
unsigned NodeProofs<Dimension>::take_out_staying(const Basis& basis, const BeadRange& range,
                                                 const SphereChord<Dimension>* chord, const Period& rest,
                                                 BeadId risen, std::vector<BeadId>& beyond) {
  if (chord == nullptr || !chord->proved) {
    beyond.clear();
    for (BeadId b = range.first; b <= range.last; ++b)
      if (!basis.contains(b)) beyond.push_back(b);
    return any_ ? look_closely(basis, 1, beyond) : 0;
  }
  const bool never_again = radii_ == Radii::equal && risen != no_bead && simulator_.now().last();
  if (never_again) std::erase(beyond, risen);
  if (!beyond.empty()) take_out_dipping(paths_, basis, *chord, rest, risen, beyond);
  unsigned stays = chord->stays;
  for (std::size_t place = 0; place < basis.size; ++place)
    if (basis.beads[place] == risen) stays |= (never_again ? ~0U : chord->rises) & (1U << place);
  const std::size_t unproved =
      beyond.size() + static_cast<std::size_t>(std::popcount(all_of(basis) & ~stays));
  return unproved < few ? stays : stays | look_closely(basis, 1, beyond);
}

/// Like take_out_until, with the sphere's chords in the four quarters of the time until `until`. The error of
/// these chords is a sixteenth of a single chord's.
template <int Dimension>
unsigned NodeProofs<Dimension>::look_closely(const Basis& basis, double until, std::vector<BeadId>& beyond) {
  constexpr std::size_t parts = Lanes::width;
  const double from = simulator_.now().lower();
  std::array<Period, parts> periods;
  std::array<Basis, parts> bases;
  std::array<SphereChord<Dimension>, parts> chords;
  bases.fill(basis);
  for (std::size_t i = 0; i < parts; ++i) {
    periods[i].from = i == 0 ? from : periods[i - 1].to;
    periods[i].to = i + 1 == parts ? until : from + 0.25 * static_cast<double>(i + 1) * (until - from);
  }
  sphere_chords<Dimension>(paths_, bases, periods, chords);
  unsigned stays = all_of(basis);
  for (auto& chord : chords) {
    if (!chord.proved) return 0;
    relax(basis, chord);
    stays &= chord.stays;
  }
  keep_beyond<Dimension>(paths_, basis, chords, periods, beyond);
  return stays;
}

template <int Dimension>
BeadId NodeProofs<Dimension>::risen_bead(const Basis& old, const Basis& next, BeadId failed) const {
  if (!any_ || !simulator_.now().isolating()) return no_bead;
  std::array<BeadId, Basis::max_size> gone{};
  std::size_t count = 0;
  for (const BeadId b : old)
    if (!next.contains(b)) gone[count++] = b;
  if (old.contains(failed)) return count == 1 && gone[0] == failed ? failed : no_bead;
  if (!next.contains(failed)) return no_bead;
  if (count == 0) return failed;
  return count == 1 && old.size == full ? gone[0] : no_bead;
}

template <int Dimension>
typename NodeProofs<Dimension>::ChordsAhead NodeProofs<Dimension>::chords_ahead(
    std::span<const Basis> bases) const {
  const double from = simulator_.now().lower();
  ChordsAhead ahead;
  Period& soon = ahead.soon;
  soon = {from, from + 0x1p-16 * (1 - from)};
  if (!(soon.to > simulator_.now().upper())) soon.to = 1;
  std::array<Basis, Lanes::width> asked;
  std::array<Period, Lanes::width> periods;
  asked.fill(bases.front());
  periods.fill(soon);
  std::copy(bases.begin(), bases.end(), asked.begin());
  if (2 * bases.size() <= Lanes::width) {
    for (std::size_t i = 0; i < bases.size(); ++i) {
      asked[bases.size() + i] = bases[i];
      periods[bases.size() + i] = rest_of_step();
    }
  }
  sphere_chords<Dimension>(paths_, asked, periods, ahead.chords);
  return ahead;
}

/// Caches the chord of the basis in this place, because it will probably be needed.
template <int Dimension>
void NodeProofs<Dimension>::keep_rest(std::span<const Basis> bases, std::size_t place, ChordsAhead& ahead) {
  if (2 * bases.size() > Lanes::width) return;
  SphereChord<Dimension>& chord = ahead.chords[bases.size() + place];
  relax(bases[place], chord);
  chord_cache_.keep(bases[place], rest_of_step(), chord);
}

template <int Dimension>
unsigned NodeProofs<Dimension>::proved_bases(std::span<const Basis> bases, BeadId newcomer) {
  ChordsAhead ahead = chords_ahead(bases);
  if (bases.size() == 1) keep_rest(bases, 0, ahead);
  unsigned proved = 0;
  for (std::size_t i = 0; i < bases.size(); ++i) {
    const SphereChord<Dimension>& chord = ahead.chords[i];
    unsigned stay = chord.stays;
    for (std::size_t place = 0; place < bases[i].size; ++place)
      if (bases[i].beads[place] == newcomer) stay |= 1U << place;
    if (chord.proved && stay == all_of(bases[i])) proved |= 1U << i;
  }
  return proved;
}

template <int Dimension>
std::optional<Basis> NodeProofs<Dimension>::proved_basis_with(const Basis& old, BeadId bead) {
  constexpr std::size_t most_of_one_size = 6;
  // Bases that drop few beads come first, because they are the most frequent.
  for (std::size_t size = std::min<std::size_t>(old.size, full - 1); size > 0; --size) {
    std::array<Basis, most_of_one_size> next;
    std::size_t count = 0;
    for (unsigned kept = 1; kept < 1U << old.size; ++kept) {
      if (static_cast<std::size_t>(std::popcount(kept)) != size) continue;
      Basis& one = next[count++];
      for (std::size_t place = 0; place < old.size; ++place)
        if ((kept >> place & 1U) != 0) one.beads[one.size++] = old.beads[place];
      insert_bead(one, bead);
    }
    for (std::size_t first = 0; first < count; first += Lanes::width) {
      const auto bases = std::span(next).subspan(first, std::min(Lanes::width, count - first));
      ChordsAhead ahead = chords_ahead(bases);
      std::array<Period, Lanes::width> periods;
      periods.fill(ahead.soon);
      for (std::size_t i = 0; i < bases.size(); ++i) {
        const SphereChord<Dimension>& chord = ahead.chords[i];
        if (!chord.proved || chord.stays != all_of(bases[i])) continue;
        left_out_.clear();
        for (const BeadId b : old)
          if (!bases[i].contains(b)) left_out_.push_back(b);
        if (!left_out_.empty()) {
          std::array<SphereChord<Dimension>, Lanes::width> chords;
          chords.fill(chord);
          keep_beyond<Dimension>(paths_, bases[i], chords, periods, left_out_);
        }
        if (!left_out_.empty()) continue;
        keep_rest(bases, i, ahead);
        return bases[i];
      }
    }
  }
  return std::nullopt;
}

template <int Dimension>
std::optional<Failure> NodeProofs<Dimension>::crossing(const Basis& basis, BeadId bead, bool inside,
                                                       bool at_own_root) {
  const Instant& now = simulator_.now();
  if (at_own_root && !now.isolating()) return std::nullopt;
  return gap_roots_.first_failure(paths_, basis, bead, inside, now.lower(), now.upper(), at_own_root);
}

template class NodeProofs<2>;
template class NodeProofs<3>;

}  // namespace kds
