#include "structures/collision/diagram_collision.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "motions/base/floating_point_guard.h"
#include "structures/collision/closest_so_far.h"
#include "structures/collision/neighbor_walk.h"

namespace kds {

namespace {

// Returns the pairs within one necklace that are not asked about.
BeadPairs near_along(const PairsAsked& asked, std::size_t beads) {
  std::vector<BeadPairs::Pair> pairs;
  for (const auto& [first, last] : asked.necklaces)
    for (BeadId a = first; a <= last; ++a)
      for (BeadId b = a + 1; b <= last && b - a < asked.apart; ++b) pairs.emplace_back(a, b);
  return {beads, pairs};
}

}  // namespace

template <int Dimension>
std::optional<std::string> diagram_refusal(const Balls<Dimension>& balls, const PairsAsked& asked) {
  const bool several = asked.necklaces.size() > 1;
  if (!asked.within || (several && !asked.between))
    return "the power diagram is of all beads together; it does not answer about some pairs of necklaces "
           "only";
  for (BeadId b = 0; b < balls.size(); ++b)
    if (!balls.equal_radii() && !std::isfinite(balls.radius(b) * balls.radius(b)))
      return "bead " + std::to_string(b) + ": the power diagram needs a radius with a finite square";
  return std::nullopt;
}

template <int Dimension>
DiagramCollision collide_by_diagram(const Balls<Dimension>& balls, const PairsAsked& asked) {
  if (const auto refusal = diagram_refusal(balls, asked)) throw std::invalid_argument(*refusal);
  const FloatingPointGuard to_nearest;
  const std::size_t beads = balls.size();
  Eigen::Matrix3Xd centers = Eigen::Matrix3Xd::Zero(3, static_cast<Eigen::Index>(beads));
  std::vector<double> weights(beads, 0);  // the value of equal radii does not matter
  for (BeadId b = 0; b < beads; ++b) {
    for (std::size_t axis = 0; axis < Dimension; ++axis)
      centers(static_cast<Eigen::Index>(axis), Eigen::Index{b}) = balls.coordinate(b, axis);
    if (!balls.equal_radii()) weights[b] = balls.radius(b) * balls.radius(b);
  }
  const DiagramEdges diagram = static_edges<Dimension>(centers, weights);
  DiagramCollision result;
  result.edges = diagram.edges.size();
  const ClosestPairReport report =
      closest_pair<Dimension>(centers, {balls.radii(), beads}, diagram, near_along(asked, beads));
  result.collide = report.collide();
  if (!result.collide) result.closest = report.pair;
  if (!balls.equal_radii()) return result;
  result.pairs = pairs_by_walk(balls, diagram, asked);
  if (!result.collide) return result;
  ClosestSoFar<Dimension> closest(balls);
  for (const BeadPair& pair : *result.pairs) closest.offer(pair.first, pair.second);
  result.closest = closest.result();
  return result;
}

template std::optional<std::string> diagram_refusal(const Balls<2>&, const PairsAsked&);
template std::optional<std::string> diagram_refusal(const Balls<3>&, const PairsAsked&);
template DiagramCollision collide_by_diagram(const Balls<2>&, const PairsAsked&);
template DiagramCollision collide_by_diagram(const Balls<3>&, const PairsAsked&);

}  // namespace kds
