#include "structures/closest/candidate_pairs.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

#include "motions/base/input_error.h"
#include "motions/curves/motion_ref.h"
#include "motions/curves/other_radii.h"
#include "motions/frames/periodic.h"

namespace kds {

namespace {

void require_room_for_another(std::size_t pairs) {
  constexpr std::size_t most_pairs = 100'000'000;
  if (pairs >= most_pairs)
    throw InputError(
        fmt::format("closest: more than {} pairs of beads may be the closest in one step; "
                    "expected fewer beads, or shorter steps",
                    most_pairs));
}

constexpr double rounded_up = 1 + 0x1p-40;  // factor above all roundings of a difference and a sum of three

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
/// all axes. Squares are avoided because they might underflow. The second bead is moved by `shift`.
struct Distance {
  double least = 0, most = 0;
};
template <int Dimension>
Distance distance(const Curves<Dimension>& curves, BeadId a, BeadId b,
                  const CellShift<Dimension>& shift = {}) {
  std::array<double, Dimension> low, high;
  low.fill(std::numeric_limits<double>::infinity());
  high.fill(-std::numeric_limits<double>::infinity());
  Distance distance;
  for (int k = 0; k <= curves.own_degree(); ++k) {
    double way = 0;
    for (int axis = 0; axis < Dimension; ++axis) {
      double d = curves.coordinate(b, k, axis) - curves.coordinate(a, k, axis);
      if (!is_zero(shift)) d += shift_coordinate(curves, shift, k, axis);
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

/// The range of the distance of two images. Sums with a shift have larger roundings than those of
/// `rounded_up`.
template <int Dimension>
class ImageDistances {
 public:
  explicit ImageDistances(const Curves<Dimension>& curves)
      : curves_(curves), middle_(0.5 * (cell_of(curves, 0) + cell_of(curves, curves.own_degree()))) {
    for (BeadId b = 0; b < curves.bead_count(); ++b)
      for (int k = 0; k <= curves.own_degree(); ++k)
        for (int axis = 0; axis < Dimension; ++axis)
          largest_ = std::max(largest_, std::abs(curves.coordinate(b, k, axis)));
  }

  [[nodiscard]] Distance between(BeadId a, BeadId b, const CellShift<Dimension>& shift) const {
    double moved = 0;
    for (int k = 0; k <= curves_.own_degree(); ++k)
      for (int axis = 0; axis < Dimension; ++axis)
        moved = std::max(moved, size_of_shift(curves_, shift, k, axis));
    const double margin = 0x1p-46 * (largest_ + moved);
    Distance range = distance(curves_, a, b, shift);
    return {range.least - margin, range.most + margin};
  }
  /// Returns a shift that brings the second bead near the first one in the middle of the step.
  [[nodiscard]] CellShift<Dimension> near_shift(BeadId a, BeadId b) const {
    Eigen::Vector3d difference = Eigen::Vector3d::Zero();
    for (int axis = 0; axis < Dimension; ++axis)
      for (const int k : {0, curves_.own_degree()})
        difference[axis] += 0.5 * (curves_.coordinate(b, k, axis) - curves_.coordinate(a, k, axis));
    const Eigen::Vector3d nearest = middle_.nearest(difference);
    CellShift<Dimension> shift{};
    constexpr double most = ShiftNumbers<Dimension>::most;
    for (int vector = 0; vector < Dimension; ++vector)
      shift[static_cast<std::size_t>(vector)] =
          static_cast<std::int32_t>(std::clamp(nearest[vector], -most, most));
    return shift;
  }

 private:
  const Curves<Dimension>& curves_;
  Images middle_;
  double largest_ = 0;
};

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
  each_near_pair(
      [&](BeadId a, BeadId b) { limit = std::min(limit, distance(curves, a, b).most * rounded_up); });
  limit *= rounded_up;
  std::vector<std::array<BeadId, 2>> pairs;
  each_near_pair([&](BeadId a, BeadId b) {
    if (distance(curves, a, b).least > limit) return;
    require_room_for_another(pairs.size());
    pairs.push_back({std::min(a, b), std::max(a, b)});
  });
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

template std::vector<std::array<BeadId, 2>> candidate_pairs(const Curves<2>&, std::span<const char>);
template std::vector<std::array<BeadId, 2>> candidate_pairs(const Curves<3>&, std::span<const char>);

// Beads that follow each other, along the chain and along each axis, give a first bound, which a search among
// the images within it makes tighter.
template <int Dimension>
std::vector<ImagePair> candidate_images(const Curves<Dimension>& curves, ShiftNumbers<Dimension>& shifts,
                                        std::span<const char> absent) {
  const auto is_absent = [&](BeadId bead) { return bead < absent.size() && absent[bead] != 0; };
  const ImageDistances<Dimension> distances(curves);
  double limit = std::numeric_limits<double>::infinity();
  std::vector<BeadId> order;
  for (BeadId bead = 0; bead < curves.bead_count(); ++bead)
    if (!is_absent(bead)) order.push_back(bead);
  for (int axis = -1; axis < Dimension; ++axis) {
    if (axis >= 0)
      std::sort(order.begin(), order.end(), [&](BeadId a, BeadId b) {
        return curves.coordinate(a, 0, axis) < curves.coordinate(b, 0, axis);
      });
    for (std::size_t k = 1; k < order.size(); ++k) {
      const BeadId a = std::min(order[k - 1], order[k]), b = std::max(order[k - 1], order[k]);
      limit = std::min(limit, distances.between(a, b, distances.near_shift(a, b)).most);
    }
  }
  if (!std::isfinite(limit)) return {};  // fewer than two beads, or doubles overflow
  const MotionRef<Dimension> motion(curves);
  const OtherRadii<Dimension> halves(motion,
                                     std::vector<double>(curves.bead_count(), 0.5 * rounded_up * limit));
  PairsAsked asked{{{0, static_cast<BeadId>(curves.bead_count() - 1)}}, true, 1};
  for (BeadId bead = 0; bead < curves.bead_count() && !absent.empty(); ++bead)
    asked.groups.push_back(is_absent(bead) ? 0 : 3);
  NearImages<Dimension> near_images(std::move(asked));
  PairsOfImages found;
  near_images.find(Curves<Dimension>(halves), true, shifts, found);
  require_room_for_another(found.unclear.size() + found.overlapping.size());
  std::vector<ImagePair> images(found.unclear.begin(), found.unclear.end());
  images.insert(images.end(), found.overlapping.begin(), found.overlapping.end());
  const auto range = [&](const ImagePair& image) {
    return distances.between(image.pair.first, image.pair.second, shifts.shift(image.shift));
  };
  for (const ImagePair& image : images) limit = std::min(limit, range(image).most);
  std::erase_if(images, [&](const ImagePair& image) { return range(image).least > limit; });
  std::sort(images.begin(), images.end());
  return images;
}

template std::vector<ImagePair> candidate_images(const Curves<2>&, ShiftNumbers<2>&, std::span<const char>);
template std::vector<ImagePair> candidate_images(const Curves<3>&, ShiftNumbers<3>&, std::span<const char>);

}  // namespace kds
