#include "motions/curves/positions.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

namespace kds {
namespace {

/// Evaluates a Bezier curve at u by de Casteljau's algorithm.
template <class Number, class Control>
Number curve_at(int degree, const Number& u, Control control) {
  std::vector<Number> p;
  for (int k = 0; k <= degree; ++k) p.emplace_back(control(k));
  const Number v = 1 - u;
  for (auto round = static_cast<std::size_t>(degree); round > 0; --round) {
    for (std::size_t i = 0; i < round; ++i) p[i] = v * p[i] + u * p[i + 1];
  }
  return p[0];
}

/// A time u and its distance 1 - u from the end.
struct RoundedTime {
  explicit RoundedTime(const Dyadic& time)
      : later{time.round_down(), time.round_up() - time.round_down()},
        earlier(TrackedDouble{1.0, 0.0} - later) {}
  TrackedDouble later, earlier;
};

/// Evaluates a Bezier curve at a time by de Casteljau's algorithm. `row` provides room for its control
/// points.
template <class Control>
TrackedDouble curve_at(const RoundedTime& time, std::vector<TrackedDouble>& row, Control control) {
  for (std::size_t k = 0; k < row.size(); ++k) row[k] = {control(static_cast<int>(k)), 0.0};
  for (std::size_t left = row.size() - 1; left > 0; --left) {
    for (std::size_t i = 0; i < left; ++i) row[i] = time.earlier * row[i] + time.later * row[i + 1];
  }
  return row[0];
}

void raise(double& bound, const TrackedDouble& number) {
  const bool is_finite = std::isfinite(number.value) && std::isfinite(number.error);
  bound = std::max(bound, is_finite ? number.error : std::numeric_limits<double>::infinity());
}

}  // namespace

namespace detail {

template <int D>
Eigen::Matrix3Xd PositionsOf<D>::control_points(const Curves<D>& curves, int k) {
  Eigen::Matrix3Xd points = Eigen::Matrix3Xd::Zero(3, static_cast<Eigen::Index>(curves.bead_count()));
  for (BeadId b = 0; b < curves.bead_count(); ++b) {
    for (int axis = 0; axis < D; ++axis) points(axis, b) = curves.coordinate(b, k, axis);
  }
  return points;
}

template <int D>
std::vector<double> PositionsOf<D>::control_weights(const Curves<D>& curves, int k) {
  std::vector<double> weights(curves.bead_count());
  for (BeadId b = 0; b < weights.size(); ++b) weights[b] = curves.weight(b, k);
  return weights;
}

template <int D>
std::vector<double> PositionsOf<D>::control_radii(const Curves<D>& curves, int k) {
  std::vector<double> radii(curves.bead_count());
  for (BeadId b = 0; b < radii.size(); ++b) radii[b] = curves.radius(b, k);
  return radii;
}

template <int D>
Eigen::Matrix3Xd PositionsOf<D>::approximate_positions(const Curves<D>& curves, double u) {
  Eigen::Matrix3Xd points = Eigen::Matrix3Xd::Zero(3, static_cast<Eigen::Index>(curves.bead_count()));
  for (BeadId b = 0; b < curves.bead_count(); ++b) {
    for (int axis = 0; axis < D; ++axis)
      points(axis, b) =
          curve_at(curves.own_degree(), u, [&](int k) { return curves.coordinate(b, k, axis); });
  }
  return points;
}

template <int D>
std::vector<double> PositionsOf<D>::approximate_radii(const Curves<D>& curves, double u) {
  std::vector<double> radii(curves.bead_count());
  for (BeadId b = 0; b < radii.size(); ++b)
    radii[b] = curve_at(curves.own_degree(), u, [&](int k) { return curves.radius(b, k); });
  return radii;
}

template <int D>
auto PositionsOf<D>::exact_position(const Curves<D>& curves, BeadId bead, const Dyadic& time)
    -> std::array<Rational, static_cast<std::size_t>(D) + 1> {
  std::array<Rational, static_cast<std::size_t>(D) + 1> position;
  for (int axis = 0; axis <= D; ++axis) {  // the weight comes last
    position[static_cast<std::size_t>(axis)] = curve_at(
        curves.own_degree(), time.rational(), [&](int k) { return curves.control_point(bead, k)[axis]; });
  }
  return position;
}

template <int D>
Rational PositionsOf<D>::exact_radius(const Curves<D>& curves, BeadId bead, const Dyadic& time) {
  return curve_at(curves.own_degree(), time.rational(), [&](int k) { return curves.radius(bead, k); });
}

template <int D>
Rational PositionsOf<D>::exact_dip(const LiftedCurves<D>& curves, BeadId bead,
                                   const Dyadic& time) requires(D > 1) {
  const Rational u = time.rational();
  Rational sum = 0;
  for (int axis = 0; axis < D; ++axis) {
    const Rational moved =
        Rational(curves.coordinate(bead, 1, axis)) - curves.coordinate(bead, 0, axis) - curves.drift(axis);
    sum += u * (1 - u) * moved * moved;
  }
  return sum;
}

template struct PositionsOf<1>;
template struct PositionsOf<2>;
template struct PositionsOf<3>;

}  // namespace detail

template <int D>
RoundedPositions<D>::RoundedPositions(const MotionRef<D>& motion, const Dyadic& time) {
  const RoundedTime at(time);
  motion.visit([&]<class Some>(const Some& curves) {
    std::vector<TrackedDouble> room(static_cast<std::size_t>(curves.own_degree()) + 1);
    rows_.resize(curves.bead_count());
    radii_.resize(curves.bead_count());
    for (BeadId b = 0; b < rows_.size(); ++b) {
      rows_[b] = {};
      for (int axis = 0; axis < D; ++axis) {
        const TrackedDouble x = curve_at(at, room, [&](int k) { return curves.coordinate(b, k, axis); });
        rows_[b][static_cast<std::size_t>(axis)] = x.value;
        raise(coordinate_error_, x);
      }
      TrackedDouble weight = curve_at(at, room, [&](int k) { return curves.weight(b, k); });
      if constexpr (lifted<Some>) {  // subtract u (1-u) |D|^2 (lifted_motion.h)
        for (int axis = 0; axis < D; ++axis) {
          const TrackedDouble moved = TrackedDouble{curves.coordinate(b, 1, axis), 0.0} -
                                      TrackedDouble{curves.coordinate(b, 0, axis), 0.0} -
                                      TrackedDouble{curves.drift(axis), 0.0};
          weight -= at.later * at.earlier * (moved * moved);
        }
      }
      rows_[b][D] = weight.value;
      raise(weight_error_, weight);
      radii_[b] = curve_at(at, room, [&](int k) { return curves.radius(b, k); });
    }
  });
}

template class RoundedPositions<2>;
template class RoundedPositions<3>;

}  // namespace kds
