#pragma once
// Collision by a power diagram that is built for the query. The diagram answers Theorem 3.5 (closest_pair.h)
// and, for equal radii, finds all pairs (neighbor_walk.h).

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
  std::uint64_t edges = 0;                     ///< edges of the diagram
  std::optional<std::vector<BeadPair>> pairs;  ///< all colliding pairs, ascending; none if radii differ
  /// The closest pair. None if beads of unequal radii collide, because a pair that was not tested may overlap
  /// more deeply.
  std::optional<ClosestPair> closest;
};

/// Returns a sentence that says why the diagram cannot answer the query, or none if it can. The diagram
/// covers all beads together, so the pairs not asked about must be neighbours along a chain.
template <int Dimension>
[[nodiscard]] std::optional<std::string> diagram_refusal(const Balls<Dimension>& balls,
                                                         const PairsAsked& asked);

/// Throws std::invalid_argument with the sentence of diagram_refusal.
template <int Dimension>
[[nodiscard]] DiagramCollision collide_by_diagram(const Balls<Dimension>& balls, const PairsAsked& asked);

}  // namespace kds
