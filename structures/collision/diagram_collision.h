#pragma once
// Collision by power diagram, built for the purpose: what Theorem 3.5 answers (closest_pair.h), and for equal
// radii all pairs (neighbor_walk.h).

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "structures/collision/closest_pair.h"
#include "structures/collision/pairs_asked.h"
#include "structures/necklace/balls.h"

namespace kds {

struct DiagramCollision {
  bool collide = false;
  std::uint64_t edges = 0;                     ///< of the diagram: the pairs it takes to prove that none do
  std::optional<std::vector<BeadPair>> pairs;  ///< all that collide, ascending; none for unequal radii
  /// The closest; none where beads of unequal radii collide, which may be deeper in others that are not
  /// looked at.
  std::optional<ClosestPair> closest;
};

/// Why the diagram does not answer this, in a sentence; nothing where it does. It is about all beads
/// together: those that are not asked about must be neighbours along a chain.
template <int Dimension>
[[nodiscard]] std::optional<std::string> diagram_refusal(const Balls<Dimension>& balls,
                                                         const PairsAsked& asked);

/// Throws std::invalid_argument with the refusal.
template <int Dimension>
[[nodiscard]] DiagramCollision collide_by_diagram(const Balls<Dimension>& balls, const PairsAsked& asked);

}  // namespace kds
