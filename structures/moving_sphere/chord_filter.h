#pragma once
// Nodes that are steady in a step: the chords of their spheres (sphere_chord.h) prove at once that none loses
// a bead and no basis changes. Most do not get past this first look at all nodes, four at a time.

#include <array>
#include <span>
#include <vector>

#include "motions/base/bead_range.h"
#include "structures/moving_sphere/sphere_chord.h"

namespace kds {

/// What the filter says of up to four nodes with bases of one size.
template <int Dimension>
struct ChordFilterResult {
  std::array<bool, 4> steady;
  // Of the others: the chord and, if that is proved, where those of their beads end in `beyond` that are not
  // proved to stay inside (beads_beyond.h).
  std::array<SphereChord<Dimension>, 4> chords;
  std::array<std::size_t, 4> ends;
};

/// Appends to `beyond`. Chords are enlarged by that factor (SphereChord::enlarge), and the limits of each
/// node's raised by a length, if any are given.
template <int Dimension>
void filter_nodes(const BeadPaths<Dimension>& paths, std::span<const BeadRange> nodes,
                  std::span<const Basis> bases, ChordFilterResult<Dimension>& look,
                  std::vector<BeadId>& beyond, double enlarged_by = 1,
                  std::span<const double> raised_by = {});

}  // namespace kds
