#pragma once
// The pairs of beads that may be the closest pair at some time of a step. Every other pair is always farther
// apart than the largest distance of some candidate pair. Proved from control points in doubles, including
// rounding. The candidates are few if beads move little compared with their distances, whatever the number of
// beads; they are all pairs if all beads meet.

#include <array>
#include <span>
#include <vector>

#include "motions/curves/curves.h"

namespace kds {

/// Returns the pairs in ascending order, each pair ascending too. Uses only beads that are not marked in
/// `absent`. Throws InputError if there are more than 10^8 pairs, which are too many to store.
template <int Dimension>
[[nodiscard]] std::vector<std::array<BeadId, 2>> candidate_pairs(const Curves<Dimension>& curves,
                                                                 std::span<const char> absent = {});

}  // namespace kds
