#include "structures/closest/candidate_pairs.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "motions/base/input_error.h"

namespace kds {

namespace {

constexpr std::size_t most_pairs = 100'000'000;
constexpr double more = 1 + 0x1p-40;  // factor above all roundings of a difference and a sum of three

/// The range of a bead's coordinate during the step.
struct Extent {
  double low, high;
  BeadId bead;
};

template <int Dimension>
std::vector<Extent> extents(const Curves<Dimension>& curves, std::span<const char> absent, int axis) {
  std::vector<Extent> all;
  for (BeadId b = 0; b < curves.bead_count(); ++b) {
    if (b < absent.size() && absent[b] != 0) continue;
    Extent extent{curves.coordinate(b, 0, axis), curves.coordinate(b, 0, axis), b};
    for (int k = 1; k <= curves.own_degree(); ++k) {
      extent.low = std::min(extent.low, curves.coordinate(b, k, axis));
      extent.high = std::max(extent.high, curves.coordinate(b, k, axis));
    }
    all.push_back(extent);
  }
  std::sort(all.begin(), all.end(), [](const Extent& a, const Extent& b) {
    return a.low != b.low ? a.low < b.low : a.bead < b.bead;
  });
  return all;
}

/// Returns the extents along the axis on which they reach farthest, where the fewest beads are level.
template <int Dimension>
std::vector<Extent> widest_extents(const Curves<Dimension>& curves, std::span<const char> absent) {
  std::vector<Extent> widest = extents(curves, absent, 0);
  if (widest.empty()) return widest;
  const auto width = [](const std::vector<Extent>& e) { return e.back().low - e.front().low; };
  for (int axis = 1; axis < Dimension; ++axis) {
    std::vector<Extent> other = extents(curves, absent, axis);
    if (width(other) > width(widest)) widest = std::move(other);
  }
  return widest;
}

/// Bounds of the distance of two beads throughout the step, up to rounding. The lower bound is the least
/// distance along the axis for which it is largest; the upper bound is the largest sum of the distances along
/// all axes. Squares are avoided because they might underflow.
struct Distance {
  double least = 0, most = 0;
};
template <int Dimension>
Distance distance(const Curves<Dimension>& curves, BeadId a, BeadId b) {
  std::array<double, Dimension> low, high;
  low.fill(std::numeric_limits<double>::infinity());
  high.fill(-std::numeric_limits<double>::infinity());
  Distance distance;
  for (int k = 0; k <= curves.own_degree(); ++k) {
    double way = 0;
    for (int axis = 0; axis < Dimension; ++axis) {
      const double d = curves.coordinate(b, k, axis) - curves.coordinate(a, k, axis);
      const auto i = static_cast<std::size_t>(axis);
      low[i] = std::min(low[i], d);
      high[i] = std::max(high[i], d);
      way += std::abs(d);
    }
    distance.most = std::max(distance.most, way);
  }
  for (std::size_t i = 0; i < Dimension; ++i) distance.least = std::max({distance.least, low[i], -high[i]});
  return distance;
}

}  // namespace

template <int Dimension>
std::vector<std::array<BeadId, 2>> candidate_pairs(const Curves<Dimension>& curves,
                                                   std::span<const char> absent) {
  const std::vector<Extent> sorted = widest_extents(curves, absent);
  double limit = std::numeric_limits<double>::infinity();
  // Visits all pairs whose extents are at most `limit` apart; `limit` may shrink meanwhile.
  const auto each_near_pair = [&](auto visit) {
    for (std::size_t i = 0; i < sorted.size(); ++i)
      for (std::size_t j = i + 1; j < sorted.size() && sorted[j].low - sorted[i].high <= limit; ++j)
        visit(sorted[i].bead, sorted[j].bead);
  };
  each_near_pair([&](BeadId a, BeadId b) { limit = std::min(limit, distance(curves, a, b).most * more); });
  limit *= more;
  std::vector<std::array<BeadId, 2>> pairs;
  each_near_pair([&](BeadId a, BeadId b) {
    if (distance(curves, a, b).least > limit) return;
    if (pairs.size() == most_pairs)
      throw InputError("closest: more than " + std::to_string(most_pairs) +
                       " pairs of beads may be the closest in one step; expected fewer beads, or shorter "
                       "steps");
    pairs.push_back({std::min(a, b), std::max(a, b)});
  });
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

template std::vector<std::array<BeadId, 2>> candidate_pairs(const Curves<2>&, std::span<const char>);
template std::vector<std::array<BeadId, 2>> candidate_pairs(const Curves<3>&, std::span<const char>);

}  // namespace kds
