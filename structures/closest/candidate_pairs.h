#pragma once
// The pairs of beads that may be the closest at some time of a step. Every other pair is always farther apart
// than the largest distance of some candidate pair. Proved from control points in doubles, including
// rounding. The candidates are few if beads move little compared with their distances; they are all pairs if
// all beads meet.

#include <array>
#include <span>
#include <vector>

#include "motions/curves/curves.h"
#include "structures/images/near_images.h"
#include "structures/images/shifted_beads.h"

namespace kds {

/// Returns the candidates in ascending order, each ascending too. Uses only beads that are not marked in
/// `absent`. Throws InputError if there are more than 10^8 pairs, which are too many to store.
template <int Dimension>
[[nodiscard]] std::vector<std::array<BeadId, 2>> candidate_pairs(const Curves<Dimension>& curves,
                                                                 std::span<const char> absent = {});

/// Returns the images of pairs that may be the closest in the cell of these curves. Numbers their shifts.
/// Throws InputError as above, and like NearImages::find.
template <int Dimension>
[[nodiscard]] std::vector<ImagePair> candidate_images(const Curves<Dimension>& curves,
                                                      ShiftNumbers<Dimension>& shifts,
                                                      std::span<const char> absent = {});

}  // namespace kds
