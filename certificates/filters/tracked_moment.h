#pragma once
// Beads during a short time, as a MotionView of constants: numbers that enclose all their values then, in
// double with errors followed operation by operation (tracked_double.h). A function's value over this view
// tells its sign for all of that time, without its polynomial; sharper than that at a single time, less sharp
// the longer it is. At a scale where numbers keep in the middle of double's range, as in TrackedView.

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <span>

#include "motions/curves/curves.h"
#include "motions/views/motion_view.h"

namespace kds {

/// 1 or -1 if that is the sign for certain, else 0.
[[nodiscard]] inline int certain_sign(const TrackedDouble& number) {
  const double error = number.error * TrackedDouble::inflation;
  return number.value > error ? 1 : number.value < -error ? -1 : 0;
}

/// A function over this view names beads by their place among those given. Of the first all are seen.
template <Motion M, std::size_t Places, Channels channels = Channels{false, true}>
class TrackedMoment {
  static_assert(!lifted<M> || !channels.weights, "weights between frames are no Bezier curves");

 public:
  using Number = TrackedDouble;
  static constexpr int dimension = M::dimension;
  static constexpr int degree = 0;

  /// From `lower` to `upper`, within [0,1].
  TrackedMoment(const M& motion, std::span<const BeadId> beads, double lower, double upper) {
    if constexpr (M::degree < 0) {  // most motion is linear, and few signs are worth loops for it
      if (degree_of(motion) == 1) {
        see(FixedCurves<dimension, 1>(Curves<dimension>(motion)), beads, lower, upper);
        return;
      }
    }
    see(motion, beads, lower, upper);
  }

  [[nodiscard]] BernsteinVector<TrackedDouble, 0, dimension> difference(BeadId i, BeadId j) const {
    BernsteinVector<TrackedDouble, 0, dimension> result;
    for (std::size_t axis = 0; axis < dimension; ++axis) result[axis].scaled[0] = between(i, j, axis);
    return result;
  }
  [[nodiscard]] Bernstein<TrackedDouble, 0> radius_difference(BeadId i, BeadId j) const
      requires(channels.radii) {
    return {{between(i, j, of_radius)}};
  }
  [[nodiscard]] Bernstein<TrackedDouble, 0> radius_sum(BeadId i, BeadId j) const requires(channels.radii) {
    return {{seen_[i][of_radius] + seen_[j][of_radius] + first_radius_ + first_radius_}};
  }
  [[nodiscard]] Bernstein<TrackedDouble, 0> weight_difference(BeadId i, BeadId j) const
      requires(channels.weights) {
    return {{between(i, j, of_weight)}};
  }

 private:
  static constexpr std::size_t of_radius = dimension, of_weight = dimension + (channels.radii ? 1 : 0);
  static constexpr std::size_t columns = of_weight + (channels.weights ? 1 : 0);

  template <Motion C>
  void see(const C& motion, std::span<const BeadId> beads, double lower, double upper) {
    const double scale = scale_to_unit<channels>(motion, beads);
    const int own = degree_of(motion);
    const TrackedDouble later{upper, 0}, earlier = rounded(1 - upper);
    const double length = own * (upper - lower) * TrackedDouble::inflation;
    const auto during = [&](auto control) { return value<C::degree>(own, control, earlier, later, length); };
    for (std::size_t place = 1; place < Places; ++place) {
      const BeadId bead = beads[place], first = beads[0];
      if (bead == first) continue;  // zero, without an error: that would be subnormal, and slow
      for (int axis = 0; axis < dimension; ++axis) {
        seen_[place][static_cast<std::size_t>(axis)] = during([&](int k) {
          return rounded((motion.coordinate(bead, k, axis) - motion.coordinate(first, k, axis)) * scale);
        });
      }
      if constexpr (channels.radii)
        seen_[place][of_radius] = during(
            [&](int k) { return rounded((motion.radius(bead, k) - motion.radius(first, k)) * scale); });
      if constexpr (channels.weights)
        seen_[place][of_weight] = during([&](int k) {
          return rounded((motion.weight(bead, k) - motion.weight(first, k)) * scale * scale);
        });
    }
    if constexpr (channels.radii)
      first_radius_ = during([&](int k) { return rounded(motion.radius(beads[0], k) * scale); });
  }

  static TrackedDouble rounded(double x) {
    return {x, TrackedDouble::unit_roundoff * std::abs(x) + TrackedDouble::lost_to_underflow};
  }
  /// The value at the end of the time, with how far it may be from that before as an error: |p'| <=
  /// degree * the steepest slope of the control polygon.
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
    if (j == 0) return seen_[i][column];
    if (i == 0) return -seen_[j][column];
    return seen_[i][column] - seen_[j][column];
  }

  std::array<std::array<TrackedDouble, columns>, Places> seen_{};  // from the first
  TrackedDouble first_radius_;
};

static_assert(MotionView<TrackedMoment<BezierMotion<3, 1>, 3>>);

}  // namespace kds
