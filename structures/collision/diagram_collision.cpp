#include "structures/collision/diagram_collision.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "motions/base/floating_point_guard.h"
#include "structures/collision/balls_meet.h"
#include "structures/collision/closest_pair.h"

namespace kds {

namespace {

// Groups beads of equal centre under the one of them that is in the diagram.
template <int Dimension>
class Coincident {
 public:
  Coincident(const Balls<Dimension>& balls, std::span<const BeadId> hidden) {
    if (hidden.empty()) return;
    std::vector<BeadId> visible;
    for (BeadId b = 0; b < balls.size(); ++b)
      if (!std::binary_search(hidden.begin(), hidden.end(), b)) visible.push_back(b);
    const auto before = [&](BeadId a, BeadId b) {
      return detail::center_of(balls, a) < detail::center_of(balls, b);
    };
    std::sort(visible.begin(), visible.end(), before);
    for (const BeadId b : hidden) {
      const auto place = std::lower_bound(visible.begin(), visible.end(), b, before);
      if (place == visible.end() || before(b, *place))
        throw std::invalid_argument("bead " + std::to_string(b) + " is hidden, but by none of its centre");
      others_.push_back({*place, b});
    }
    std::sort(others_.begin(), others_.end());
  }

  /// Calls visit(b) for the bead and for all others with its centre.
  template <class Visit>
  void for_each_at(BeadId bead, const Visit& visit) const {
    visit(bead);
    const BeadPair none_before{bead, 0};
    for (auto other = std::lower_bound(others_.begin(), others_.end(), none_before);
         other != others_.end() && other->first == bead; ++other)
      visit(other->second);
  }

 private:
  std::vector<BeadPair> others_;
};

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
std::vector<BeadPair> pairs_by_walk(const Balls<Dimension>& balls, const DiagramEdges& diagram,
                                    const PairsAsked& asked, double distance) {
  if (!balls.equal_radii()) throw std::invalid_argument("only balls of equal radii are found by walking");
  const FloatingPointGuard to_nearest;
  const Coincident<Dimension> coincident(balls, diagram.hidden);
  std::vector<BeadPair> pairs;
  const auto add = [&](BeadId a, BeadId b) {
    const auto [first, second] = std::minmax(a, b);
    if (first != second && asked.asks({first, second})) pairs.push_back({first, second});
  };
  std::vector<BeadId> met_from(balls.size(), no_bead);  // the last walk that met the bead
  std::vector<BeadId> walk;
  for (BeadId start = 0; start < balls.size(); ++start) {
    if (std::binary_search(diagram.hidden.begin(), diagram.hidden.end(), start)) continue;
    const Point<Dimension> center = detail::center_of(balls, start);
    const double radius = balls.radius(start);
    walk.assign(1, start);
    met_from[start] = start;
    for (std::size_t at = 0; at < walk.size(); ++at) {
      for (const BeadId b : diagram.edges.of(walk[at])) {
        if (met_from[b] == start) continue;
        met_from[b] = start;
        if (within<Dimension>(center, detail::center_of(balls, b), radius, radius, distance))
          walk.push_back(b);
      }
    }
    for (const BeadId b : walk) {
      if (b < start) continue;  // found by the walk from b
      coincident.for_each_at(start, [&](BeadId of_start) {
        coincident.for_each_at(b, [&](BeadId other) {
          if (b != start || of_start < other) add(of_start, other);
        });
      });
    }
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

template std::vector<BeadPair> pairs_by_walk(const Balls<2>&, const DiagramEdges&, const PairsAsked&, double);
template std::vector<BeadPair> pairs_by_walk(const Balls<3>&, const DiagramEdges&, const PairsAsked&, double);

template <int Dimension>
std::optional<std::string> diagram_refusal(const Balls<Dimension>& balls, const PairsAsked& asked) {
  const bool several = asked.necklaces.size() > 1;
  if (!asked.within || (several && !asked.between))
    return "the power diagram is of all beads together; it does not answer about some pairs of necklaces "
           "only";
  if (!asked.at_rest.empty())
    return "the power diagram is of all beads together; it does not leave out pairs of beads at rest";
  if (!asked.groups.empty())
    return "the power diagram is of all beads together; it does not answer about groups of beads only";
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
