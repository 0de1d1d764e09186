#pragma once
// Proves that a moving sphere is not much larger than the minimum enclosing sphere at all times of a part of
// a step.
//
// The bound. Let balls x_i(u), r_i(u) lie in a sphere of radius S at c, and let m_i >= 0 be weights whose sum
// is 1. Then (S - r_i)^2 >= |x_i - c|^2. The weighted sum of these inequalities, with bars for weighted
// means, is
//
//   (S - r-bar)^2 + sum m_i (r_i - r-bar)^2 >= sum m_i |x_i - c|^2 >= sum m_i |x_i - x-bar|^2.
//
// So the smallest radius is at least r-bar + sqrt(V - v) for any weights, where V is the weighted variance of
// the points and v that of the radii. Equality holds at one time if the weights are the barycentric
// coordinates of the smallest sphere's centre in the basis that spans it. The bound is then tangent to the
// smallest radius at that time, and better elsewhere, because sqrt(V) is convex in linear motion. For the
// sphere R(u) under test, let rho = R - r-bar. Then
//
//   G(u) = rho^2 + v - V
//
// is a polynomial of twice the motion's degree. Let tau = R / (1 + eps) - r-bar. R <= (1 + eps) R_opt holds
// wherever tau <= 0 or G <= rho^2 - tau^2, because the latter gives r-bar + sqrt(rho^2 - G) >= R / (1 + eps).
// With s := rho - tau = eps / (1 + eps) R, the limit is rho^2 - tau^2 = s (s + 2 tau). If tau is positive
// there, this limit is least for the least R and the greatest r-bar. The limit is never less than s^2 for the
// least R. In linear motion G = (1-u) G_0 + u G_2 + u (1-u) Q, which is at most
// max(G_0, G_2) + max(Q, 0) / 4.
//
// Rounding: weights need no accuracy, because any weights give a bound. Positions are taken relative to the
// sphere's centres, so that all numbers have the size of R. The rounding errors are far below the allowance
// of 2^-42 R^2.

#include <array>
#include <span>
#include <vector>

#include "motions/curves/curves.h"
#include "structures/chord_cages/outward_cages.h"
#include "structures/enclosing_sphere/basis.h"
#include "structures/necklace/balls.h"
#include "structures/necklace/necklace_tree.h"

namespace kds {

/// The moving sphere of a node over a part of a step.
template <int Dimension>
struct CagePiece {
  double from = 0, to = 1;             ///< whole multiples of 2^-25
  std::vector<Cage<Dimension>> cages;  ///< at the control points of the part
  std::array<Basis, 2> bases;          ///< of the smallest spheres at its ends
};

/// A bead at the k-th control point of its curve's part: coordinates, then radius. The numbers are rounded
/// unless the part is the whole step.
template <int Dimension>
using ControlBall = std::array<double, static_cast<std::size_t>(Dimension) + 1>;
template <int Dimension>
[[nodiscard]] ControlBall<Dimension> control_ball(const Curves<Dimension>& curves, BeadId bead, double from,
                                                  double to, int k);
/// Returns an upper bound of the distance between a control ball and the exact one, the error of its radius
/// included. No coordinate or radius of the bead's control points exceeds `size`.
[[nodiscard]] inline double control_ball_error(int degree, double size) {
  return degree * (0x1p-49 * size + 0x1p-1060);
}

/// Returns whether the sixth powers of lengths of this size keep their digits. No other lengths are judged.
[[nodiscard]] inline bool is_judged(double radius) { return radius >= 0x1p-150 && radius <= 0x1p150; }

/// Returns whether the radius is proved to be within 1 + tightness of the smallest at all times of the piece.
/// `error` bounds the error of the control balls.
template <int Dimension>
[[nodiscard]] bool is_proved_tight(const Curves<Dimension>& curves, const CagePiece<Dimension>& piece,
                                   double tightness, double error);

/// Input for judging many nodes in linear motion at once: balls, cages and bases at both ends.
template <int Dimension>
struct LinearStep {
  const Balls<Dimension>& start;
  const Balls<Dimension>& end;
  OutwardCages<Dimension> start_cages, end_cages;
  std::span<const Basis> start_bases;
};

/// Finds the nodes that a first test, four nodes at a time, does not prove tight.
template <int Dimension>
void find_loose_nodes(const LinearStep<Dimension>& step, double tightness, std::vector<NodeId>& loose);

}  // namespace kds
