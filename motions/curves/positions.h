#pragma once
// Where the beads are at one time of a step.

#include <Eigen/Core>
#include <array>
#include <vector>

#include "motions/curves/bezier_motion.h"
#include "motions/curves/elevated_motion.h"
#include "motions/numbers/exact_number.h"

namespace kds {

/// The k-th control points; k = 0 and k = degree are the positions at the ends of the step, exactly.
template <Motion M>
[[nodiscard]] Eigen::Matrix3Xd control_points(const M& motion, int k) {
  Eigen::Matrix3Xd points = Eigen::Matrix3Xd::Zero(3, static_cast<Eigen::Index>(motion.bead_count()));
  for (BeadId b = 0; b < motion.bead_count(); ++b) {
    for (int axis = 0; axis < M::dimension; ++axis) points(axis, b) = motion.coordinate(b, k, axis);
  }
  return points;
}

template <Motion M>
[[nodiscard]] std::vector<double> control_weights(const M& motion, int k) {
  std::vector<double> weights(motion.bead_count());
  for (BeadId b = 0; b < motion.bead_count(); ++b) weights[b] = motion.weight(b, k);
  return weights;
}

template <Motion M>
[[nodiscard]] std::vector<double> control_radii(const M& motion, int k) {
  std::vector<double> radii(motion.bead_count());
  for (BeadId b = 0; b < motion.bead_count(); ++b) radii[b] = motion.radius(b, k);
  return radii;
}

namespace detail {

/// A Bezier curve at u, rounded a few times.
template <std::size_t N>
[[nodiscard]] double approximate_curve_at(std::array<double, N> p, double u) {
  for (std::size_t round = N - 1; round > 0; --round) {
    for (std::size_t i = 0; i < round; ++i) p[i] = (1 - u) * p[i] + u * p[i + 1];
  }
  return p[0];
}

}  // namespace detail

/// The positions at u in [0,1], each rounded a few times.
template <Motion M>
[[nodiscard]] Eigen::Matrix3Xd approximate_positions(const M& motion, double u) {
  Eigen::Matrix3Xd points = Eigen::Matrix3Xd::Zero(3, static_cast<Eigen::Index>(motion.bead_count()));
  for (BeadId b = 0; b < motion.bead_count(); ++b) {
    for (int axis = 0; axis < M::dimension; ++axis) {
      std::array<double, M::degree + 1> p;
      for (int k = 0; k <= M::degree; ++k) p[static_cast<std::size_t>(k)] = motion.coordinate(b, k, axis);
      points(axis, b) = detail::approximate_curve_at(p, u);
    }
  }
  return points;
}

template <Motion M>
[[nodiscard]] std::vector<double> approximate_radii(const M& motion, double u) {
  std::vector<double> radii(motion.bead_count());
  for (BeadId b = 0; b < motion.bead_count(); ++b) {
    std::array<double, M::degree + 1> p;
    for (int k = 0; k <= M::degree; ++k) p[static_cast<std::size_t>(k)] = motion.radius(b, k);
    radii[b] = detail::approximate_curve_at(p, u);
  }
  return radii;
}

namespace detail {

/// The Bezier curve of the first degree + 1 of these control points. Exact.
template <std::size_t N>
[[nodiscard]] Rational curve_at(std::array<Rational, N> p, int degree, const Rational& u) {
  const Rational v = 1 - u;
  for (auto round = static_cast<std::size_t>(degree); round > 0; --round) {
    for (std::size_t i = 0; i < round; ++i) p[i] = v * p[i] + u * p[i + 1];
  }
  return p[0];
}

}  // namespace detail

/// Coordinates and, last, the weight of a bead at `time`. Exact; also for what a lifted motion makes of the
/// weight.
template <Motion M>
[[nodiscard]] std::array<Rational, M::dimension + 1> exact_position(const M& motion, BeadId bead,
                                                                    const Dyadic& time) {
  const Rational u = time.rational();
  std::array<Rational, M::dimension + 1> position;
  for (int axis = 0; axis <= M::dimension; ++axis) {
    std::array<Rational, M::degree + 1> p;
    for (int k = 0; k <= M::degree; ++k) {
      p[static_cast<std::size_t>(k)] =
          axis < M::dimension ? motion.coordinate(bead, k, axis) : motion.weight(bead, k);
    }
    position[static_cast<std::size_t>(axis)] = detail::curve_at(p, own_degree(motion), u);
  }
  if constexpr (lifted<M>) {
    for (int axis = 0; axis < M::dimension; ++axis) {
      const Rational moved =
          Rational(motion.coordinate(bead, 1, axis)) - motion.coordinate(bead, 0, axis) - motion.drift(axis);
      position.back() -= u * (1 - u) * moved * moved;
    }
  }
  return position;
}

/// The radius of a bead at `time`. Exact.
template <Motion M>
[[nodiscard]] Rational exact_radius(const M& motion, BeadId bead, const Dyadic& time) {
  std::array<Rational, M::degree + 1> p;
  for (int k = 0; k <= M::degree; ++k) p[static_cast<std::size_t>(k)] = motion.radius(bead, k);
  return detail::curve_at(p, own_degree(motion), time.rational());
}

}  // namespace kds
