#pragma once
// Beads during a short time, as a MotionView of constants: numbers that enclose all their values then, in
// double with errors followed operation by operation (tracked_double.h). A function's value over this view
// tells its sign for all of that time, without its polynomial; sharper than that at a single time, less sharp
// the longer it is. At a scale where numbers keep in the middle of double's range, as in TrackedView.

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>

#include "motions/views/motion_view.h"

namespace kds {

/// 1 or -1 if that is the sign for certain, else 0.
[[nodiscard]] inline int certain_sign(const TrackedDouble& number) {
  const double error = number.error * TrackedDouble::inflation;
  return number.value > error ? 1 : number.value < -error ? -1 : 0;
}

/// A function over this view names beads by their place among those given. Of the first all are seen.
template <Motion M, std::size_t Places>
class TrackedMoment {
  static_assert(!lifted<M>);

 public:
  using Number = TrackedDouble;
  static constexpr int dimension = M::dimension;
  static constexpr int degree = 0;

  /// From `lower` to `upper`, within [0,1].
  TrackedMoment(const M& motion, const std::array<BeadId, Places>& beads, double lower, double upper) {
    const double scale = scale_to_unit<Channels{false, true}>(motion, beads);
    const TrackedDouble later{upper, 0}, earlier = rounded(1 - upper);
    const double length = M::degree * (upper - lower) * TrackedDouble::inflation;
    for (std::size_t place = 1; place < Places; ++place) {
      for (int axis = 0; axis <= dimension; ++axis) {
        seen_[place][static_cast<std::size_t>(axis)] = value(
            [&](int k) {
              const auto of = [&](BeadId b) {
                return axis < dimension ? motion.coordinate(b, k, axis) : motion.radius(b, k);
              };
              return rounded((of(beads[place]) - of(beads[0])) * scale);
            },
            earlier, later, length);
      }
    }
  }

  [[nodiscard]] BernsteinVector<TrackedDouble, 0, dimension> difference(BeadId i, BeadId j) const {
    BernsteinVector<TrackedDouble, 0, dimension> result;
    for (std::size_t axis = 0; axis < dimension; ++axis) result[axis].scaled[0] = between(i, j, axis);
    return result;
  }
  [[nodiscard]] Bernstein<TrackedDouble, 0> radius_difference(BeadId i, BeadId j) const {
    return {{between(i, j, dimension)}};
  }

 private:
  static TrackedDouble rounded(double x) {
    return {x, TrackedDouble::unit_roundoff * std::abs(x) + TrackedDouble::lost_to_underflow};
  }
  /// At the end, and how far it may be from that before: |p'| <= degree * the steepest of the control
  /// polygon.
  template <std::invocable<int> Control>
  static TrackedDouble value(Control control, const TrackedDouble& earlier, const TrackedDouble& later,
                             double length) {
    std::array<TrackedDouble, M::degree + 1> points;
    double steepest = 0;
    for (std::size_t k = 0; k < points.size(); ++k) {
      points[k] = control(static_cast<int>(k));
      if (k > 0)
        steepest = std::max(steepest, std::abs(points[k].value - points[k - 1].value) + points[k].error +
                                          points[k - 1].error);
    }
    for (std::size_t round = M::degree; round > 0; --round) {
      for (std::size_t k = 0; k < round; ++k) points[k] = earlier * points[k] + later * points[k + 1];
    }
    points[0].error += steepest * length;
    return points[0];
  }
  [[nodiscard]] TrackedDouble between(BeadId i, BeadId j, std::size_t column) const {
    if (j == 0) return seen_[i][column];
    if (i == 0) return -seen_[j][column];
    return seen_[i][column] - seen_[j][column];
  }

  std::array<std::array<TrackedDouble, dimension + 1>, Places> seen_{};  // from the first
};

static_assert(MotionView<TrackedMoment<BezierMotion<3, 1>, 3>>);

}  // namespace kds
