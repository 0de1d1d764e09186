#pragma once
// Finds nodes that are steady in a step: the chords of their spheres (sphere_chord.h) prove at once that the
// node loses no bead and its basis does not change. This first filter over all nodes, four at a time, settles
// most of them.

#include <array>
#include <span>
#include <vector>

#include "motions/base/bead_range.h"
#include "structures/moving_sphere/sphere_chord.h"

namespace kds {

/// The filter's result for up to four nodes with bases of one size.
template <int Dimension>
struct ChordFilterResult {
  std::array<bool, 4> steady;
  // For nodes that are not steady: the chord and, if the chord is proved, the end in `beyond` of the node's
  // beads that are not proved to stay inside (beads_beyond.h).
  std::array<SphereChord<Dimension>, 4> chords;
  std::array<std::size_t, 4> ends;
};

/// Appends to `beyond`. Chords are enlarged by `enlarged_by` (SphereChord::enlarge). If lengths are given,
/// each node's limits are raised by its length.
template <int Dimension>
void filter_nodes(const BeadPaths<Dimension>& paths, std::span<const BeadRange> nodes,
                  std::span<const Basis> bases, ChordFilterResult<Dimension>& look,
                  std::vector<BeadId>& beyond, double enlarged_by = 1,
                  std::span<const double> raised_by = {});

}  // namespace kds
