#pragma once
// Beads during a short time, as a MotionView of constants. Each constant encloses all values of that time: it
// is a double with a running error bound (rounding_error.h). A function evaluated over this view has a
// certain sign during all of that time, without forming its polynomial. The result is sharper than evaluating
// the polynomial at a single time, and less sharp the longer the time is. Numbers are scaled to the middle of
// double's range, as in TrackedView.

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <span>

#include "motions/curves/curves.h"
#include "motions/views/motion_view.h"

namespace kds {

/// Returns 1 or -1 if that is certainly the sign, else 0.
[[nodiscard]] inline int certain_sign(const TrackedDouble& number) {
  const double error = number.error * TrackedDouble::inflation;
  return number.value > error ? 1 : number.value < -error ? -1 : 0;
}

/// A function over this view names beads by their indices among those given. Weights of a lifted motion are
/// not available, because they are not Bezier curves between frames.
template <Motion M>
class TrackedMoment {
 public:
  using Number = TrackedDouble;
  static constexpr int dimension = M::dimension;
  static constexpr int degree = 0;

  /// Constructs the view of the time from `lower` to `upper`, within [0,1].
  TrackedMoment(const M& motion, std::span<const BeadId> beads, double lower, double upper,
                Channels channels) {
    seen_.resize(beads.size() * columns);
    if constexpr (M::degree < 0) {  // most motion is linear, and few signs are worth a general loop
      if (degree_of(motion) == 1) {
        see(FixedCurves<dimension, 1>(Curves<dimension>(motion)), beads, lower, upper, channels);
        return;
      }
    }
    see(motion, beads, lower, upper, channels);
  }

  [[nodiscard]] BernsteinVector<TrackedDouble, 0, dimension> difference(BeadId i, BeadId j) const {
    BernsteinVector<TrackedDouble, 0, dimension> result;
    for (std::size_t axis = 0; axis < dimension; ++axis) result[axis].scaled[0] = between(i, j, axis);
    return result;
  }
  [[nodiscard]] Bernstein<TrackedDouble, 0> radius_difference(BeadId i, BeadId j) const {
    return {{between(i, j, of_radius)}};
  }
  [[nodiscard]] Bernstein<TrackedDouble, 0> radius_sum(BeadId i, BeadId j) const {
    return {{seen(i, of_radius) + seen(j, of_radius) + first_radius_ + first_radius_}};
  }
  [[nodiscard]] Bernstein<TrackedDouble, 0> weight(BeadId i) const {
    return {{seen(i, of_weight) + first_weight_}};
  }
  [[nodiscard]] Bernstein<TrackedDouble, 0> weight_difference(BeadId i, BeadId j) const {
    return {{between(i, j, of_weight)}};
  }

 private:
  static constexpr std::size_t of_radius = dimension, of_weight = dimension + 1, columns = dimension + 2;

  template <Motion C>
  void see(const C& motion, std::span<const BeadId> beads, double lower, double upper, Channels channels) {
    const double scale = scale_to_unit(motion, beads, channels);
    const int own = degree_of(motion);
    const TrackedDouble later{upper, 0}, earlier = rounded(1 - upper);
    const double length = own * (upper - lower) * TrackedDouble::inflation;
    const auto during = [&](auto control) { return value<C::degree>(own, control, earlier, later, length); };
    std::fill_n(seen_.begin(), columns, TrackedDouble{});
    for (std::size_t index = 1; index < beads.size(); ++index) {
      const BeadId bead = beads[index], first = beads[0];
      TrackedDouble* const row = seen_.begin() + index * columns;
      if (bead == first) {  // exactly zero: computing it would give a subnormal error, which is slow
        std::fill_n(row, columns, TrackedDouble{});
        continue;
      }
      for (int axis = 0; axis < dimension; ++axis) {
        row[axis] = during([&](int k) {
          return rounded((motion.coordinate(bead, k, axis) - motion.coordinate(first, k, axis)) * scale);
        });
      }
      if (channels.radii)
        row[of_radius] = during(
            [&](int k) { return rounded((motion.radius(bead, k) - motion.radius(first, k)) * scale); });
      if (channels.weights)
        row[of_weight] = during([&](int k) {
          return rounded((motion.weight(bead, k) - motion.weight(first, k)) * scale * scale);
        });
    }
    if (channels.radii)
      first_radius_ = during([&](int k) { return rounded(motion.radius(beads[0], k) * scale); });
    if (channels.weights)
      first_weight_ = during([&](int k) { return rounded(motion.weight(beads[0], k) * scale * scale); });
  }

  static TrackedDouble rounded(double x) {
    return {x, TrackedDouble::unit_roundoff * std::abs(x) + TrackedDouble::lost_to_underflow};
  }
  /// Returns the value at the end of the time. The error of the value includes how much it may differ during
  /// the time: |p'| <= degree * the steepest slope of the control polygon.
  template <int curve_degree, std::invocable<int> Control>
  static TrackedDouble value(int own_degree, Control control, const TrackedDouble& earlier,
                             const TrackedDouble& later, double length) {
    Bernstein<TrackedDouble, curve_degree> curve;
    curve.set_degree(own_degree);
    auto& points = curve.scaled;
    double steepest = 0;
    for (std::size_t k = 0; k < points.size(); ++k) {
      points[k] = control(static_cast<int>(k));
      if (k > 0)
        steepest = std::max(steepest, std::abs(points[k].value - points[k - 1].value) + points[k].error +
                                          points[k - 1].error);
    }
    for (std::size_t round = points.size() - 1; round > 0; --round) {
      for (std::size_t k = 0; k < round; ++k) points[k] = earlier * points[k] + later * points[k + 1];
    }
    points[0].error += steepest * length;
    return points[0];
  }
  [[nodiscard]] TrackedDouble between(BeadId i, BeadId j, std::size_t column) const {
    if (j == 0) return seen(i, column);
    if (i == 0) return -seen(j, column);
    return seen(i, column) - seen(j, column);
  }
  [[nodiscard]] const TrackedDouble& seen(std::size_t index, std::size_t column) const {
    return seen_[index * columns + column];
  }

  Coefficients<TrackedDouble> seen_;  // rows of the beads, from the first; columns not requested are not set
  TrackedDouble first_radius_, first_weight_;
};

static_assert(MotionView<TrackedMoment<BezierMotion<3, 1>>>);

}  // namespace kds
