#pragma once
// Finds the beads that a sphere may lose during a step: those that its chord (sphere_chord.h) does not prove
// to stay inside. A first filter over all nodes, four at a time, settles most of them: a node is steady if
// the chord of its sphere proves at once that it loses no bead and its basis does not change.

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "motions/base/bead.h"
#include "structures/moving_sphere/sphere_chord.h"

namespace kds {

/// Sets `beyond` to the beads of a range, ascending and without basis beads, that are not proved to stay
/// inside the sphere with this chord. The chord begins at time `from`.
template <int Dimension>
void find_beyond(const BeadPaths<Dimension>& paths, const BeadRange& range, const Basis& basis,
                 const SphereChord<Dimension>& chord, double from, std::vector<BeadId>& beyond);

/// Removes from `beyond` the beads that are proved to stay inside once the chord's dip is taken into account.
/// Works in linear motion only. `risen` is no_bead or a bead that is on the sphere at a time before `sure`
/// and is known to be inside from then until `sure`.
template <int Dimension>
void take_out_dipping(const BeadPaths<Dimension>& paths, const Basis& basis,
                      const SphereChord<Dimension>& chord, const Period& period, BeadId risen,
                      std::vector<BeadId>& beyond);

/// Removes from `beyond` the beads that are proved to stay inside in each of four periods.
template <int Dimension>
void keep_beyond(const BeadPaths<Dimension>& paths, const Basis& basis,
                 std::span<const SphereChord<Dimension>, 4> chords, std::span<const Period, 4> periods,
                 std::vector<BeadId>& beyond);

/// The filter's result for up to four nodes with bases of one size.
template <int Dimension>
struct ChordFilterResult {
  std::array<bool, 4> steady;
  // For nodes that are not steady: the chord and, if the chord is proved, the end in `beyond` of the node's
  // beads that are not proved to stay inside (beads_beyond.h).
  std::array<SphereChord<Dimension>, 4> chords;
  std::array<std::size_t, 4> ends;
};

/// Filters up to four nodes with bases of one size. Appends to `beyond`.
template <int Dimension>
void filter_nodes(const BeadPaths<Dimension>& paths, std::span<const BeadRange> nodes,
                  std::span<const Basis> bases, ChordFilterResult<Dimension>& look,
                  std::vector<BeadId>& beyond);

}  // namespace kds
