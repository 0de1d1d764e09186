#pragma once
// Collision by power diagram (Agarwal et al., section 3.2, Theorem 3.5): of a few pairs of beads, those that
// the diagram and the family of neighbours name, one is the closest of all that are no neighbours.
//
// Neighbours are the pairs that may meet, in a necklace consecutive beads; all others should not. Distance is
// between closed balls, |ci - cj| - ri - rj: touching is a collision. The pairs looked at:
//
//   edges of the diagram                                                                    (DT1)
//   beads with a common neighbour                                                           (DT2)
//   a bead with a neighbour that does not connect it, and every other bead                  (DT3)
//   a bead whose centre is not in its own power cell, and the bead in whose cell it is      (not in the
//   paper)
//
// B connects A to the rest if B meets a third bead that is no neighbour of A. In a necklace whose consecutive
// beads meet, only the first and the last bead connect no one, so DT3 is about the beads beside them.
//
// What holds, for balls of any radii, any family of neighbours, in any position, hidden beads among them:
//
//   1. Some beads that are no neighbours collide if and only if a pair looked at does. DT3 is not needed for
//      that. (Proof: let Bi and Bj meet in x. The segment from the centre of Bi to x runs through cells whose
//      balls all contain points of it where their power is at most that of Bi: each meets Bi and the next.
//      If no edge collides they are neighbours one after the other, so none but Bi and its neighbours can
//      come without a collision of DT2, or of the first cell's bead. The same for Bj: the bead of the cell at
//      x is a common neighbour.)
//   2. If none collide, the pair returned is the closest, of several equally close the first by ids. (Proof
//   in
//      the paper, which uses of a neighbour Bk of Bi what is said of connecting above. Where the distance is
//      positive the edge's empty orthogonal ball is strictly empty: the edge is there however ties are
//      broken.)
//
// What does not: if some collide, the pair returned collides, but others may be deeper in one another, or
// touch as well. As printed, the theorem fails where neighbours do not meet (chain breaks, thin beads): there
// a bead may lie between two others without connecting anything. And a neighbour C of B that is also one of A
// does not help, disjoint from A or not. Here such beads are treated as DT3 has it: at n pairs each, or,
// where there are more than a few, with the pairs that a grid finds as near as the closest known by then.
//
// Exact. The diagram must be that of the weights r^2, rounded to doubles. Where this rounding could matter,
// which takes unequal radii and a closest pair about 2^-14 of the largest radius apart or less, a grid finds
// the near pairs instead (near_pairs.h) and is counted.

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>

#include "structures/necklace/bead_pairs.h"
#include "structures/triangulation/diagram_edges.h"

namespace kds {

struct ClosestPair {
  BeadId first, second;  ///< ascending
  int sign;              ///< of the distance: 1 disjoint, 0 touching, -1 overlapping
  double distance;       ///< rounded
};

/// Pairs looked at, by what named them first.
struct PairsLookedAt {
  std::uint64_t edges = 0;
  std::uint64_t common_neighbors = 0;
  std::uint64_t unconnected = 0;
  std::uint64_t centers = 0;
  std::uint64_t near = 0;
};

struct ClosestPairReport {
  std::optional<ClosestPair> pair;  ///< none if all beads are neighbours of each other
  PairsLookedAt looked_at;
  [[nodiscard]] bool collide() const { return pair && pair->sign <= 0; }
};

/// Centres have three rows; in the plane the third is not looked at. Finite; radii finite, not negative. Time
/// linear in beads, edges and pairs with a common neighbour, and in the near pairs (near_pairs.h) where a
/// grid is asked.
template <int Dimension>
[[nodiscard]] ClosestPairReport closest_pair(const Eigen::Matrix3Xd& centers, std::span<const double> radii,
                                             const DiagramEdges& diagram, const BeadPairs& neighbors);

/// The closest pair, with a diagram built for the purpose.
template <int Dimension>
[[nodiscard]] ClosestPairReport closest_pair(const Eigen::Matrix3Xd& centers, std::span<const double> radii,
                                             const BeadPairs& neighbors);

}  // namespace kds
