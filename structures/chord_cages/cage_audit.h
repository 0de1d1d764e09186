#pragma once
// Whether cages hold their beads, in exact arithmetic.

#include <optional>
#include <span>
#include <string>

#include "motions/curves/curves.h"
#include "motions/numbers/exact_number.h"
#include "structures/chord_cages/outward_cages.h"
#include "structures/necklace/necklace_tree.h"

namespace kds {

/// The node and bead of the first ball that sticks out of a cage at the k-th control point. A radius that has
/// overflowed holds all.
template <int Dimension>
[[nodiscard]] std::optional<std::string> ball_outside(const NecklaceTree& tree, OutwardCages<Dimension> cages,
                                                      const Curves<Dimension>& curves, int k);

/// The same at a time, of cages blended from those of all control points: `cages[k]`.
template <int Dimension>
[[nodiscard]] std::optional<std::string> ball_outside_at(const NecklaceTree& tree,
                                                         std::span<const OutwardCages<Dimension>> cages,
                                                         const Curves<Dimension>& curves, const Dyadic& time);

}  // namespace kds
