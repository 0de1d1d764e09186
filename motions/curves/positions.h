#pragma once
// The positions of the beads at one time of a step: exact, rounded, and in doubles with error
// bounds.

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "motions/curves/bezier_motion.h"
#include "motions/curves/curves.h"
#include "motions/curves/motion_ref.h"
#include "motions/numbers/exact_number.h"
#include "motions/numbers/rounding_error.h"

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

/// Positions of the beads at one time of a step, in doubles with error bounds (ball arithmetic), computed
/// from the control points. These positions decide nearly every sign that an audit needs; integers decide the
/// others.
template <int Dimension>
class RoundedPositions {
 public:
  /// The coordinates, then the weight, padded to four numbers.
  using Row = std::array<double, 4>;

  /// Rounding must be to nearest.
  RoundedPositions(const MotionRef<Dimension>& motion, const Dyadic& time);

  [[nodiscard]] std::size_t size() const { return rows_.size(); }
  [[nodiscard]] const Row& row(BeadId bead) const { return rows_[bead]; }
  /// Return bounds on the error of every coordinate and of every weight. The bounds are infinite if a number
  /// overflows.
  [[nodiscard]] double coordinate_error() const { return coordinate_error_; }
  [[nodiscard]] double weight_error() const { return weight_error_; }

  [[nodiscard]] TrackedDouble coordinate(BeadId bead, std::size_t axis) const {
    return {rows_[bead][axis], coordinate_error_};
  }
  [[nodiscard]] TrackedDouble radius(BeadId bead) const { return radii_[bead]; }

 private:
  std::vector<Row> rows_;
  std::vector<TrackedDouble> radii_;
  double coordinate_error_ = 0, weight_error_ = 0;
};

extern template class RoundedPositions<2>;
extern template class RoundedPositions<3>;

}  // namespace kds
