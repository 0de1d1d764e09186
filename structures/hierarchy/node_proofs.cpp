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
                                  const Curves<Dimension>& curves, int degree, Radii radii)
    : simulator_(simulator),
      tree_(tree),
      curves_(curves),
      radii_(radii),
      any_(simulator.kernel() != Kernel::exact && degree >= 1 && degree <= BeadPaths<Dimension>::most_degree),
      proves_crossings_(any_ && simulator.kernel() == Kernel::filtered && degree == 1),
      slack_(tree) {}

template <int Dimension>
void NodeProofs<Dimension>::take_curves() {
  if (!any_) return;
  paths_.set(curves_, radii_ == Radii::equal);
  gap_roots_.forget();
  chord_cache_.forget();
}

// A pair of balls needs a certificate if neither holds the other. A pair of beads of equal radius needs one
// if their centres differ.
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
void NodeProofs<Dimension>::take_out_skipped(std::span<const Basis> bases, std::vector<NodeId>& nodes) {
  if (any_) slack_.take_out_skipped(paths_, bases, nodes);
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
    std::size_t count = 0;
  };
  std::array<Waiting, full + 1> of_size;
  ChordFilterResult<Dimension> look;
  const auto look_at = [&](Waiting& w) {
    filter_nodes<Dimension>(paths_, std::span(w.ranges).first(w.count), std::span(w.bases).first(w.count),
                            look, beyond_);
    for (std::size_t i = 0; i < w.count; ++i)
      if (!look.steady[i]) candidates_.push_back({w.nodes[i], look.chords[i], look.ends[i]});
    w.count = 0;
  };
  for (const NodeId id : nodes) {
    Waiting& w = of_size[bases[id].size];
    w.nodes[w.count] = id;
    w.ranges[w.count] = tree_.range(id);
    w.bases[w.count] = bases[id];
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
    chord = &chord_cache_.of(paths_, basis, rest);
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
  for (std::size_t index = 0; index < basis.size; ++index)
    if (basis.beads[index] == risen) stays |= (never_again ? ~0U : chord->rises) & (1U << index);
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
  for (const auto& chord : chords) {
    if (!chord.proved) return 0;
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
unsigned NodeProofs<Dimension>::proved_bases(std::span<const Basis> bases, BeadId newcomer) {
  const double from = simulator_.now().lower();
  Period soon{from, from + 0x1p-16 * (1 - from)};
  if (!(soon.to > simulator_.now().upper())) soon.to = 1;
  std::array<Basis, Lanes::width> asked;
  std::array<Period, Lanes::width> periods;
  std::array<SphereChord<Dimension>, Lanes::width> chords;
  asked.fill(bases.front());
  periods.fill(soon);
  std::copy(bases.begin(), bases.end(), asked.begin());
  const bool is_alone = bases.size() == 1;
  if (is_alone) periods[1] = rest_of_step();
  sphere_chords<Dimension>(paths_, asked, periods, chords);
  if (is_alone) chord_cache_.keep(bases[0], periods[1], chords[1]);  // it will probably be needed
  unsigned proved = 0;
  for (std::size_t i = 0; i < bases.size(); ++i) {
    const SphereChord<Dimension>& chord = chords[i];
    unsigned stay = chord.stays;
    for (std::size_t index = 0; index < bases[i].size; ++index)
      if (bases[i].beads[index] == newcomer) stay |= 1U << index;
    if (chord.proved && stay == all_of(bases[i])) proved |= 1U << i;
  }
  return proved;
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
