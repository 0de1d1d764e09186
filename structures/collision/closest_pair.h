#pragma once
// Collision by power diagram (Agarwal et al., section 3.2, Theorem 3.5). The diagram and the family of
// neighbours name a few candidate pairs of beads. One of the candidates is the closest of all pairs that are
// not neighbours.
//
// Neighbours are the pairs that may meet; in a necklace these are consecutive beads. All other pairs should
// be disjoint. Distance is measured between closed balls, |ci - cj| - ri - rj, so touching is a collision.
// The candidates are:
//
//   edges of the diagram                                                                    (DT1)
//   beads with a common neighbour                                                           (DT2)
//   a bead with a neighbour that does not connect it, and every other bead                  (DT3)
//   a bead whose centre is outside its own power cell, and the bead of the cell around it
//                                                                            (not in the paper)
//
// B connects A to the rest if B meets a third bead that is not a neighbour of A. In a necklace whose
// consecutive beads meet, only the first and the last bead connect no bead, so DT3 concerns only the beads
// beside them.
//
// Two statements hold for balls of any radii, any family of neighbours and any position, hidden beads
// included:
//
//   1. Some pair of beads that are not neighbours collides if and only if a candidate does. DT3 is not needed
//      for this. Proof: let Bi and Bj meet in x. Follow the segment from the centre of Bi to x through the
//      power cells. At each point of the segment, the cell's ball has at most the power of Bi, so it contains
//      the point. Each of these balls therefore meets Bi and the next ball. If no edge collides, consecutive
//      balls are neighbours. Then only Bi and its neighbours can occur, unless DT2 or the bead of the first
//      cell gives a collision. This holds for Bj too, so the bead of the cell at x is a common neighbour.
//   2. If none collide, the returned pair is the closest. If several are equally close, it is the first by
//      ids. The proof is in the paper; it uses the property of a neighbour Bk of Bi that is called "connects"
//      above. If the distance is positive, the edge's empty orthogonal ball is strictly empty, so the edge
//      exists however ties are broken.
//
// If some pairs collide, the returned pair collides, but others may overlap more deeply or touch as well. As
// printed, the theorem fails if neighbours do not meet (chain breaks, thin beads): a bead may then lie
// between two others without connecting anything. A neighbour C of B that is also a neighbour of A does not
// help, disjoint from A or not. The code treats such beads by DT3, at n pairs each. If there are more than a
// few such beads, a grid finds only the pairs that are as near as the closest pair known by then.
//
// The result is exact. The diagram must be the diagram of the weights r^2, rounded to doubles. This rounding
// can matter only if radii are unequal and the closest pair is at most about 2^-14 of the largest radius
// apart. Then a grid finds the near pairs instead (near_pairs.h), and their number is reported.

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>

#include "structures/necklace/balls.h"
#include "structures/necklace/bead_pairs.h"
#include "structures/triangulation/diagram_edges.h"

namespace kds {

struct ClosestPair {
  BeadId first, second;  ///< ascending
  int sign;              ///< the distance's sign: 1 disjoint, 0 touching, -1 overlapping
  double distance;       ///< rounded
};

/// Numbers of pairs tested. A pair that several rules name counts for the first of them.
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

/// Returns the closest pair of a scene with a given diagram. Centres have three rows; the plane ignores the
/// third. All numbers are finite and no radius is negative. Takes time linear in the number of beads, edges
/// and pairs with a common neighbour, and in the number of near pairs (near_pairs.h) if a grid is used.
template <int Dimension>
[[nodiscard]] ClosestPairReport closest_pair(const Eigen::Matrix3Xd& centers, std::span<const double> radii,
                                             const DiagramEdges& diagram, const BeadPairs& neighbors);

/// Returns the closest pair and builds the diagram itself.
template <int Dimension>
[[nodiscard]] ClosestPairReport closest_pair(const Eigen::Matrix3Xd& centers, std::span<const double> radii,
                                             const BeadPairs& neighbors);

/// Keeps the closest of the pairs of balls that are offered, decided exactly.
template <int Dimension>
class ClosestSoFar {
 public:
  explicit ClosestSoFar(const Balls<Dimension>& balls) : balls_(&balls) {}

  /// Offers two beads in any order. If pairs are equally close, the first by ids wins.
  void offer(BeadId a, BeadId b);

  /// Returns an upper bound of the distance of the closest pair so far, infinite if there is none.
  [[nodiscard]] double at_most() const { return at_most_; }
  [[nodiscard]] std::optional<ClosestPair> result() const;

 private:
  [[nodiscard]] Eigen::Vector3d center(BeadId bead) const;
  void take(BeadId a, BeadId b);

  const Balls<Dimension>* balls_;
  std::optional<ClosestPair> best_;  // the sign is computed at the end
  double at_most_ = HUGE_VAL;
};

/// Returns a bound of the error of the distance of two balls, if it is computed as sqrt(square) - reach in
/// double.
[[nodiscard]] inline double error_of_gap(double distance_of_centers, double reach) {
  return 0x1p-46 * (distance_of_centers + reach) + 0x1p-490;
}

}  // namespace kds
