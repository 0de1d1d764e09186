#include "structures/closest/least_distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
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

/// The difference of two centres and a bound of the numbers that it is made of.
template <int Dimension>
struct Difference {
  CurvePart<Dimension> whole;
  double extent = 0;
};

template <int Dimension>
Difference<Dimension> difference(const Curves<Dimension>& curves, BeadId a, BeadId b,
                                 const CellShift<Dimension>& shift) {
  Difference<Dimension> difference;
  for (int k = 0; k <= curves.own_degree(); ++k) {
    Vector<Dimension>& point = difference.whole.points.emplace_back();
    double way = 0;
    for (int axis = 0; axis < Dimension; ++axis) {
      double d = curves.coordinate(b, k, axis) - curves.coordinate(a, k, axis);
      if (!is_zero(shift)) {
        way += std::abs(d) + size_of_shift(curves, shift, k, axis);
        d += shift_coordinate(curves, shift, k, axis);
      }
      point[static_cast<std::size_t>(axis)] = d;
      way += std::abs(d);
    }
    difference.extent = std::max(difference.extent, way);
  }
  return difference;
}

}  // namespace

template <int Dimension>
LeastDistance least_distance(const Curves<Dimension>& curves, BeadId a, BeadId b,
                             const CellShift<Dimension>& shift) {
  auto [whole, extent] = difference(curves, a, b, shift);
  std::vector<CurvePart<Dimension>> parts{std::move(whole)};
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

template LeastDistance least_distance(const Curves<2>&, BeadId, BeadId, const CellShift<2>&);
template LeastDistance least_distance(const Curves<3>&, BeadId, BeadId, const CellShift<3>&);

}  // namespace kds
