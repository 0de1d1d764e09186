#pragma once
// Checks in exact arithmetic that cages hold their beads.

#include <optional>
#include <span>
#include <string>

#include "motions/curves/curves.h"
#include "motions/numbers/exact_number.h"
#include "structures/chord_cages/outward_cages.h"
#include "structures/necklace/necklace_tree.h"

namespace kds {

/// Returns the node and bead of the first ball that sticks out of a cage at the k-th control point, or none.
/// A cage whose radius has overflowed holds all balls.
template <int Dimension>
[[nodiscard]] std::optional<std::string> ball_outside(const NecklaceTree& tree, OutwardCages<Dimension> cages,
                                                      const Curves<Dimension>& curves, int k);

/// Does the check at time `time` for cages blended from the cages of all control points. `cages[k]` are those
/// of control point k.
template <int Dimension>
[[nodiscard]] std::optional<std::string> ball_outside_at(const NecklaceTree& tree,
                                                         std::span<const OutwardCages<Dimension>> cages,
                                                         const Curves<Dimension>& curves, const Dyadic& time);

}  // namespace kds
