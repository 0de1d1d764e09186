#include "structures/closest/least_distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace kds {

namespace {

constexpr int most_halvings = 48;

template <int Dimension>
using Vector = std::array<double, Dimension>;

template <int Dimension>
double length(const Vector<Dimension>& v) {
  if constexpr (Dimension == 2) return std::hypot(v[0], v[1]);
  if constexpr (Dimension == 3) return std::hypot(v[0], v[1], v[2]);
}

/// The difference of two centres on a part of the step, in Bernstein form.
template <int Dimension>
struct CurvePart {
  std::vector<Vector<Dimension>> points;
  double from = 0;
  int halvings = 0;

  /// Splits the part by de Casteljau's algorithm. Keeps the later half and returns the earlier one.
  [[nodiscard]] CurvePart split_off_first_half() {
    CurvePart first{points, from, ++halvings};
    from += std::ldexp(1.0, -halvings);
    for (std::size_t round = 1; round < points.size(); ++round) {
      for (std::size_t k = 0; k + round < points.size(); ++k)
        for (std::size_t axis = 0; axis < Dimension; ++axis)
          points[k][axis] = 0.5 * points[k][axis] + 0.5 * points[k + 1][axis];
      first.points[round] = points[0];
    }
    return first;
  }
  /// Returns a lower bound of the length of the difference on this part, up to rounding.
  [[nodiscard]] double least_along(const Vector<Dimension>& direction) const {
    const double norm = length<Dimension>(direction);
    if (!(norm > 0)) return 0;
    double least = HUGE_VAL;
    for (const Vector<Dimension>& point : points) {
      double along = 0;
      for (std::size_t axis = 0; axis < Dimension; ++axis) along += direction[axis] / norm * point[axis];
      least = std::min(least, along);
    }
    return least;
  }
};

template <int Dimension>
CurvePart<Dimension> difference(const Curves<Dimension>& curves, BeadId a, BeadId b) {
  CurvePart<Dimension> whole;
  for (int k = 0; k <= curves.own_degree(); ++k) {
    Vector<Dimension>& point = whole.points.emplace_back();
    for (int axis = 0; axis < Dimension; ++axis)
      point[static_cast<std::size_t>(axis)] = curves.coordinate(b, k, axis) - curves.coordinate(a, k, axis);
  }
  return whole;
}

}  // namespace

template <int Dimension>
LeastDistance least_distance(const Curves<Dimension>& curves, BeadId a, BeadId b) {
  std::vector<CurvePart<Dimension>> parts{difference(curves, a, b)};
  double extent = 0;
  for (const Vector<Dimension>& point : parts.front().points) {
    double way = 0;
    for (const double along : point) way += std::abs(along);
    extent = std::max(extent, way);
  }
  const double margin = 0x1p-40 * extent + 0x1p-1060;
  if (!(extent + 8 * margin < HUGE_VAL)) return {0, HUGE_VAL, 0};
  LeastDistance least{HUGE_VAL, HUGE_VAL, 0};
  const auto look_at = [&](const Vector<Dimension>& d, double u) {
    const double distance = length<Dimension>(d) + margin;
    if (!(distance < least.upper)) return;
    least.upper = distance;
    least.at = u;
  };
  look_at(parts.front().points.front(), 0);
  look_at(parts.front().points.back(), 1);
  while (!parts.empty()) {
    CurvePart<Dimension> later = std::move(parts.back());
    parts.pop_back();
    CurvePart<Dimension> first = later.split_off_first_half();
    const Vector<Dimension>& middle = later.points.front();
    look_at(middle, later.from);
    const double lower =
        std::max(0.0, std::min(first.least_along(middle), later.least_along(middle)) - margin);
    if (lower >= least.upper * (1 - 0x1p-36) - 4 * margin || later.halvings > most_halvings) {
      least.lower = std::min(least.lower, lower);
    } else {
      parts.push_back(std::move(first));
      parts.push_back(std::move(later));
    }
  }
  return least;
}

template LeastDistance least_distance(const Curves<2>&, BeadId, BeadId);
template LeastDistance least_distance(const Curves<3>&, BeadId, BeadId);

}  // namespace kds
