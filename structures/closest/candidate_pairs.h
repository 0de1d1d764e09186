#pragma once
// The pairs of beads that may be the closest at some time of a step: all others are always farther apart than
// some pair ever is. Proved from control points in double, rounding included. Where beads move little beside
// their distances these are few, whatever the number of beads; where all meet, all pairs.

#include <array>
#include <span>
#include <vector>

#include "motions/curves/curves.h"

namespace kds {

/// Ascending, each pair too; of beads that are not marked as absent, if any are. Throws InputError where
/// there are more than 10^8, which is too many to hold.
template <int Dimension>
[[nodiscard]] std::vector<std::array<BeadId, 2>> candidate_pairs(const Curves<Dimension>& curves,
                                                                 std::span<const char> absent = {});

}  // namespace kds
