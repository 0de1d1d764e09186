#include "structures/collision/closest_pair.h"

#include <algorithm>
#include <cmath>
#include <concepts>
#include <stdexcept>
#include <utility>
#include <vector>

#include "motions/base/floating_point_scope.h"
#include "motions/scene/near_pairs.h"
#include "structures/collision/balls_meet.h"
#include "structures/necklace/ball_distance.h"

namespace kds {

namespace {

std::vector<double> squares(std::span<const double> radii) {
  std::vector<double> result;
  result.reserve(radii.size());
  for (const double r : radii) result.push_back(r * r);
  return result;
}

// Returns whether the diagram of the rounded squares may differ from the diagram of the balls. If all weights
// are equal, their value does not change the diagram.
bool rounds_squares(std::span<const double> radii) {
  const auto rounds = [](double r) { return std::fma(r, r, -(r * r)) != 0 || (r != 0 && r * r < 0x1p-900); };
  const bool equal = std::all_of(radii.begin(), radii.end(), [&](double r) { return r == radii[0]; });
  return !equal && std::any_of(radii.begin(), radii.end(), rounds);
}

class Search {
 public:
  Search(const Eigen::Matrix3Xd& centers, std::span<const double> radii, const DiagramEdges& diagram,
         const BeadPairs& neighbors)
      : centers_(centers),
        radii_(radii),
        weights_(squares(radii)),
        edges_(diagram.edges),
        hidden_(diagram.hidden),
        neighbors_(neighbors),
        rounded_(rounds_squares(radii)) {}

  [[nodiscard]] ClosestPairReport run() && {
    look_at_edges();
    look_at_common_neighbors();
    look_at_unconnected();
    look_at_centers();
    if (rounding_matters())
      look_at_near_pairs([this](BeadId a, BeadId b) { look_at(a, b, report_.looked_at.near); });
    if (report_.pair) {
      ClosestPair& p = *report_.pair;
      p.sign = compare_distance(center(p.first), center(p.second), radii_[p.first], radii_[p.second]);
    }
    return std::move(report_);
  }

 private:
  [[nodiscard]] std::size_t bead_count() const { return radii_.size(); }
  [[nodiscard]] Eigen::Vector3d center(BeadId b) const { return centers_.col(Eigen::Index{b}); }

  void look_at(BeadId a, BeadId b, std::uint64_t& counter) {
    if (a == b || neighbors_.contains(a, b)) return;
    ++counter;
    if (b < a) std::swap(a, b);
    const double distance = (center(a) - center(b)).stableNorm() - (radii_[a] + radii_[b]);
    auto& best = report_.pair;
    if (best) {
      if (best->first == a && best->second == b) return;
      const int order = compare_gaps(center(a), center(b), {radii_[a], radii_[b]}, center(best->first),
                                     center(best->second), {radii_[best->first], radii_[best->second]});
      const bool closer = order < 0 || (order == 0 && std::pair(a, b) < std::pair(best->first, best->second));
      if (!closer) return;
    }
    best = ClosestPair{a, b, 0, distance};
  }

  void look_at_edges() {
    for (BeadId a = 0; a < bead_count(); ++a) {
      for (const BeadId b : edges_.of(a)) {
        if (a < b) look_at(a, b, report_.looked_at.edges);
      }
    }
  }

  void look_at_common_neighbors() {
    for (BeadId a = 0; a < bead_count(); ++a) {
      for (const BeadId middle : neighbors_.of(a)) {
        for (const BeadId b : neighbors_.of(middle)) {
          if (a < b) look_at(a, b, report_.looked_at.common_neighbors);
        }
      }
    }
  }

  // The answer must not depend on the rounding of the squares.
  [[nodiscard]] bool certainly_meet(BeadId a, BeadId b) const {
    if (!rounded_) return compare_distance(center(a), center(b), radii_[a], radii_[b]) <= 0;
    return (center(a) - center(b)).stableNorm() <= (radii_[a] + radii_[b]) * (1 - 0x1p-48);
  }
  [[nodiscard]] bool connects(BeadId b, BeadId a) const {
    const auto others = neighbors_.of(b);
    return std::any_of(others.begin(), others.end(), [&](BeadId c) {
      return c != a && !neighbors_.contains(a, c) && certainly_meet(b, c);
    });
  }
  void look_at_unconnected() {
    std::vector<char> unconnected(bead_count(), 0);
    std::size_t count = 0;
    for (BeadId a = 0; a < bead_count(); ++a) {
      const auto beside = neighbors_.of(a);
      if (std::all_of(beside.begin(), beside.end(), [&](BeadId b) { return connects(b, a); })) continue;
      unconnected[a] = 1;
      ++count;
    }
    constexpr std::size_t few = 16;
    if (count > few && report_.pair) {
      return look_at_near_pairs([&](BeadId a, BeadId b) {
        if (unconnected[a] != 0 || unconnected[b] != 0) look_at(a, b, report_.looked_at.unconnected);
      });
    }
    for (BeadId a = 0; a < bead_count(); ++a) {
      if (unconnected[a] == 0) continue;
      for (BeadId b = 0; b < bead_count(); ++b) look_at(a, b, report_.looked_at.unconnected);
    }
  }

  void look_at_centers() {
    std::vector<char> is_hidden(bead_count(), 0);
    for (const BeadId b : hidden_) is_hidden[b] = 1;
    const auto visible = std::find(is_hidden.begin(), is_hidden.end(), 0);
    auto near = static_cast<BeadId>(visible - is_hidden.begin());  // a visible bead, near at best
    for (BeadId a = 0; a < bead_count(); ++a) {
      if (is_hidden[a] == 0) near = a;
      const BeadId at = owner_of_center(a, near);
      if (at != a) look_at(a, at, report_.looked_at.centers);
      near = at;
    }
  }
  /// Returns the bead whose cell holds the centre of a. Cells are convex, so a bead has the least power at a
  /// point if no bead joined to it has less power there.
  [[nodiscard]] BeadId owner_of_center(BeadId a, BeadId from) const {
    while (true) {
      BeadId best = from;
      for (const BeadId b : edges_.of(from)) {
        if (from == a && weights_[b] <= weights_[a]) continue;  // b's power is not below that of a
        if (compare_powers(center(a), center(b), weights_[b], center(best), weights_[best]) < 0) best = b;
      }
      if (best == from) return from;
      from = best;
    }
  }

  // The diagram is exactly the diagram of balls of radii r' with |r' - r| <= 2^-53 R, where R is the largest
  // radius. Let the closest candidate be farther apart than x. Then no balls of radii r' collide
  // (by 1 in the header), so a closest pair of these balls is a candidate (by 2). A closest pair of our balls
  // is a closest pair of theirs up to 4 x 2^-53 R. For such a pair the paper's inequalities, reduced by this
  // amount at each use, leave Bk's power at the middle of the orthogonal ball above the pair's power by at
  // least
  //   x^3 / (4 (x + 2R)) - 2^-50 R (x + 3R).
  // The bound is positive for x > 2^-14 R, so the pair is an edge.
  [[nodiscard]] bool rounding_matters() const {
    if (!rounded_ || !report_.pair) return false;
    const ClosestPair& p = *report_.pair;
    if (compare_distance(center(p.first), center(p.second), radii_[p.first], radii_[p.second]) <= 0)
      return false;
    const double largest = *std::max_element(radii_.begin(), radii_.end());
    return !(largest > 0x1p-400 && p.distance > 0x1p-14 * largest);
  }
  /// Visits all pairs that may be as close as the closest pair so far.
  template <std::invocable<BeadId, BeadId> Visit>
  void look_at_near_pairs(Visit visit) const {
    const auto& p = *report_.pair;
    const double reach = std::max(0.0, p.distance);
    const double off = ((center(p.first) - center(p.second)).stableNorm() + reach) * 0x1p-40;
    std::vector<double> inflated;
    for (const double r : radii_) inflated.push_back((r + 0.5 * reach + off) * (1 + 0x1p-50));
    visit_near_pairs(centers_, inflated, visit);
  }

  const Eigen::Matrix3Xd& centers_;
  std::span<const double> radii_;
  std::vector<double> weights_;
  const BeadPairs& edges_;
  std::span<const BeadId> hidden_;
  const BeadPairs& neighbors_;
  bool rounded_;
  ClosestPairReport report_;
};

}  // namespace

template <int Dimension>
ClosestPairReport closest_pair(const Eigen::Matrix3Xd& centers, std::span<const double> radii,
                               const DiagramEdges& diagram, const BeadPairs& neighbors) {
  const FloatingPointScope to_nearest;
  const std::size_t beads = radii.size();
  if (static_cast<std::size_t>(centers.cols()) != beads || diagram.edges.bead_count() != beads ||
      neighbors.bead_count() != beads)
    throw std::invalid_argument("centres, radii, diagram and neighbours must be of the same beads");
  if constexpr (Dimension == 3) return Search(centers, radii, diagram, neighbors).run();
  Eigen::Matrix3Xd flat = centers;
  flat.row(2).setZero();
  return Search(flat, radii, diagram, neighbors).run();
}

template <int Dimension>
ClosestPairReport closest_pair(const Eigen::Matrix3Xd& centers, std::span<const double> radii,
                               const BeadPairs& neighbors) {
  const FloatingPointScope to_nearest;
  return closest_pair<Dimension>(centers, radii, static_edges<Dimension>(centers, squares(radii)), neighbors);
}

template ClosestPairReport closest_pair<2>(const Eigen::Matrix3Xd&, std::span<const double>,
                                           const DiagramEdges&, const BeadPairs&);
template ClosestPairReport closest_pair<3>(const Eigen::Matrix3Xd&, std::span<const double>,
                                           const DiagramEdges&, const BeadPairs&);
template ClosestPairReport closest_pair<2>(const Eigen::Matrix3Xd&, std::span<const double>,
                                           const BeadPairs&);
template ClosestPairReport closest_pair<3>(const Eigen::Matrix3Xd&, std::span<const double>,
                                           const BeadPairs&);

template <int Dimension>
Eigen::Vector3d ClosestSoFar<Dimension>::center(BeadId bead) const {
  return in_space<Dimension>(detail::center_of(*balls_, bead));
}

template <int Dimension>
void ClosestSoFar<Dimension>::offer(BeadId a, BeadId b) {
  if (b < a) std::swap(a, b);
  if (!best_) return take(a, b);
  const Point<Dimension> d = detail::minus(detail::center_of(*balls_, b), detail::center_of(*balls_, a));
  const double distance = std::sqrt(detail::dot(d, d));
  const double r = balls_->radius(a), s = balls_->radius(b);
  if (distance - (r + s) - error_of_gap(distance, r + s) > at_most_) return;
  const BeadId i = best_->first, j = best_->second;
  const int order = compare_gaps(center(a), center(b), {r, s}, center(i), center(j),
                                 {balls_->radius(i), balls_->radius(j)});
  if (order < 0 || (order == 0 && std::pair(a, b) < std::pair(i, j))) take(a, b);
}

template <int Dimension>
void ClosestSoFar<Dimension>::take(BeadId a, BeadId b) {
  const double distance = (center(a) - center(b)).stableNorm();
  const double reach = balls_->radius(a) + balls_->radius(b);
  best_ = ClosestPair{a, b, 0, distance - reach};
  at_most_ = distance - reach + error_of_gap(distance, reach);
  if (!(at_most_ < HUGE_VAL)) at_most_ = HUGE_VAL;
}

template <int Dimension>
std::optional<ClosestPair> ClosestSoFar<Dimension>::result() const {
  std::optional<ClosestPair> result = best_;
  if (result)
    result->sign = compare_distance(center(result->first), center(result->second),
                                    balls_->radius(result->first), balls_->radius(result->second));
  return result;
}

template class ClosestSoFar<2>;
template class ClosestSoFar<3>;

}  // namespace kds
