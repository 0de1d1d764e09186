#pragma once
// The motions of beads over a piece of a step, enclosed to first order (mean_value.h). Enclosures of the
// exact curves: control points of the piece by blossoming, hulls of those and of their differences.

#include <array>
#include <concepts>

#include "certificates/conservative/mean_value.h"
#include "motions/curves/curves.h"
#include "motions/numbers/bernstein.h"

namespace kds {

template <Motion M>
class PieceView {
 public:
  using Vector = std::array<MeanValue, static_cast<std::size_t>(M::dimension)>;

  /// [lower, upper] within [0,1].
  PieceView(const M& motion, double lower, double upper)
      : motion_(motion), lower_(parameter(lower)), upper_(parameter(upper)) {}

  /// centre of i minus centre of j
  [[nodiscard]] Vector difference(BeadId i, BeadId j) const {
    Vector result;
    for (int axis = 0; axis < M::dimension; ++axis) {
      result[static_cast<std::size_t>(axis)] = enclosed([&](int k) {
        return Interval(motion_.coordinate(i, k, axis)) - Interval(motion_.coordinate(j, k, axis));
      });
    }
    return result;
  }
  /// radius of i minus radius of j
  [[nodiscard]] MeanValue radius_difference(BeadId i, BeadId j) const {
    return enclosed([&](int k) { return Interval(motion_.radius(i, k)) - Interval(motion_.radius(j, k)); });
  }
  [[nodiscard]] MeanValue radius(BeadId i) const {
    return enclosed([&](int k) { return Interval(motion_.radius(i, k)); });
  }

 private:
  using Points = decltype(Bernstein<Interval, M::degree>::scaled);
  struct Parameter {
    Interval u, v;  // v = 1 - u
  };
  static Parameter parameter(double u) { return {Interval(u), Interval(1) - Interval(u)}; }

  static Interval between(const Interval& a, const Interval& b, const Parameter& t) {
    return t.v * a + t.u * b;
  }

  template <std::invocable<int> Control>
  [[nodiscard]] MeanValue enclosed(Control control) const {
    Bernstein<Interval, M::degree> curve;
    curve.set_degree(degree_of(motion_));
    Points& points = curve.scaled;
    const std::size_t degree = points.size() - 1;
    bool constant = true;
    for (std::size_t k = 0; k <= degree; ++k) {
      points[k] = control(static_cast<int>(k));
      constant &= points[k].lower == points[0].lower && points[k].upper == points[0].upper;
    }
    if (constant) return {points[0], points[0], Interval(0)};
    // Point i of the piece: `upper` in i arguments of the blossom, `lower` in the others.
    Points piece = points;
    for (std::size_t i = 0; i <= degree; ++i) {
      Points p = points;
      for (std::size_t round = degree; round > 0; --round) {
        for (std::size_t k = 0; k < round; ++k) p[k] = between(p[k], p[k + 1], round <= i ? upper_ : lower_);
      }
      piece[i] = p[0];
    }
    Interval range = piece[0];
    Interval slope = piece[1] - piece[0];
    for (std::size_t i = 1; i <= degree; ++i) {
      range = Interval::hull(range, piece[i]);
      slope = Interval::hull(slope, piece[i] - piece[i - 1]);
    }
    for (std::size_t round = degree; round > 0; --round) {
      for (std::size_t i = 0; i < round; ++i) piece[i] = Interval(0.5) * (piece[i] + piece[i + 1]);
    }
    return {piece[0], range, Interval(static_cast<double>(degree)) * slope};
  }

  const M& motion_;
  Parameter lower_, upper_;
};

}  // namespace kds
