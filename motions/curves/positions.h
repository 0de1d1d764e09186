#pragma once
// The positions of the beads at one time of a step.

#include <Eigen/Core>
#include <array>
#include <vector>

#include "motions/curves/curves.h"
#include "motions/numbers/exact_number.h"

namespace kds {

namespace detail {

template <int Dimension>
struct PositionsOf {
  static Eigen::Matrix3Xd control_points(const Curves<Dimension>& curves, int k);
  static std::vector<double> control_weights(const Curves<Dimension>& curves, int k);
  static std::vector<double> control_radii(const Curves<Dimension>& curves, int k);
  static Eigen::Matrix3Xd approximate_positions(const Curves<Dimension>& curves, double u);
  static std::vector<double> approximate_radii(const Curves<Dimension>& curves, double u);
  static std::array<Rational, static_cast<std::size_t>(Dimension) + 1> exact_position(
      const Curves<Dimension>& curves, BeadId bead, const Dyadic& time);
  static Rational exact_radius(const Curves<Dimension>& curves, BeadId bead, const Dyadic& time);
  /// Returns u (1-u) |D|^2, by which a bead's weight in lifted motion is less than linear (lifted_motion.h).
  static Rational exact_dip(const LiftedCurves<Dimension>& curves, BeadId bead,
                            const Dyadic& time) requires(Dimension > 1);
};

}  // namespace detail

/// Returns the k-th control points. k = 0 and k = degree give the exact positions at the ends of the step.
template <Motion M>
[[nodiscard]] Eigen::Matrix3Xd control_points(const M& motion, int k) {
  return detail::PositionsOf<M::dimension>::control_points(CurvesOf<M>(motion), k);
}
template <Motion M>
[[nodiscard]] std::vector<double> control_weights(const M& motion, int k) {
  return detail::PositionsOf<M::dimension>::control_weights(CurvesOf<M>(motion), k);
}
template <Motion M>
[[nodiscard]] std::vector<double> control_radii(const M& motion, int k) {
  return detail::PositionsOf<M::dimension>::control_radii(CurvesOf<M>(motion), k);
}

/// Returns the positions at u in [0,1], each with a few roundings.
template <Motion M>
[[nodiscard]] Eigen::Matrix3Xd approximate_positions(const M& motion, double u) {
  return detail::PositionsOf<M::dimension>::approximate_positions(CurvesOf<M>(motion), u);
}
template <Motion M>
[[nodiscard]] std::vector<double> approximate_radii(const M& motion, double u) {
  return detail::PositionsOf<M::dimension>::approximate_radii(CurvesOf<M>(motion), u);
}

/// Returns the exact coordinates of a bead at `time`, followed by its weight; in lifted motion its fictitious
/// weight.
template <Motion M>
[[nodiscard]] auto exact_position(const M& motion, BeadId bead, const Dyadic& time) {
  using Positions = detail::PositionsOf<M::dimension>;
  const CurvesOf<M> curves(motion);
  auto position = Positions::exact_position(curves, bead, time);
  if constexpr (lifted<M>) position.back() -= Positions::exact_dip(curves, bead, time);
  return position;
}

/// Returns the exact radius of a bead at `time`.
template <Motion M>
[[nodiscard]] Rational exact_radius(const M& motion, BeadId bead, const Dyadic& time) {
  return detail::PositionsOf<M::dimension>::exact_radius(CurvesOf<M>(motion), bead, time);
}

}  // namespace kds
