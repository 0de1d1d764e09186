#include "motions/curves/positions.h"

namespace kds::detail {
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

}  // namespace

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
  for (int place = 0; place <= D; ++place) {  // the weight comes last
    position[static_cast<std::size_t>(place)] = curve_at(
        curves.own_degree(), time.rational(), [&](int k) { return curves.control_point(bead, k)[place]; });
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

}  // namespace kds::detail
