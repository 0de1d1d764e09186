#pragma once
// Proofs that a moving sphere is not much larger than the smallest one, at all times of a part of a step.
//
// The bound. Let balls x_i(u), r_i(u) lie in a sphere of radius S at c, and m_i >= 0 be weights whose sum is
// 1. Then (S - r_i)^2 >= |x_i - c|^2, and the sum of these with the weights, bars for means,
//
//   (S - r-bar)^2 + sum m_i (r_i - r-bar)^2 >= sum m_i |x_i - c|^2 >= sum m_i |x_i - x-bar|^2,
//
// so the smallest radius is at least r-bar + sqrt(V - v), V the variance of the points by these weights and v
// that of the radii, whatever the weights. Those of the centre of a smallest sphere in the basis that spans
// it make this an equality at its time (so the bound is as good as a tangent there, and better elsewhere, as
// sqrt(V) is convex in linear motion). With rho = R - r-bar for the sphere R(u) that is to be judged,
//
//   G(u) = rho^2 + v - V
//
// is a polynomial of twice the motion's degree, and R <= (1 + eps) R_opt wherever
// tau = R / (1 + eps) - r-bar <= 0, or G <= rho^2 - tau^2: then r-bar + sqrt(rho^2 - G) >= R / (1 + eps).
// As rho - tau = eps / (1 + eps) R =: s, that is s (s + 2 tau), which is least where R is least and r-bar
// greatest, as long as tau is positive there, and nowhere less than s^2 for the least R. In linear motion G =
// (1-u) G_0 + u G_2 + u (1-u) Q, at most max(G_0, G_2) + max(Q, 0) / 4.
//
// Rounding: weights are what they are; positions are taken from the sphere's centres, so that all numbers are
// of the size of R, and 2^-42 R^2 is far more than they err.

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

/// A bead at the k-th control point of its curve's part: coordinates, then the radius. Rounded, unless the
/// part is the whole.
template <int Dimension>
using ControlBall = std::array<double, static_cast<std::size_t>(Dimension) + 1>;
template <int Dimension>
[[nodiscard]] ControlBall<Dimension> control_ball(const Curves<Dimension>& curves, BeadId bead, double from,
                                                  double to, int k);
/// How far it is from the true one at most, its radius' error included; `size`: no coordinate or radius of
/// the bead's control points is larger.
[[nodiscard]] inline double control_ball_error(int degree, double size) {
  return degree * (0x1p-49 * size + 0x1p-1060);
}

/// Whether lengths of this size have sixth powers that keep their digits: others prove nothing.
[[nodiscard]] inline bool is_judged(double radius) { return radius >= 0x1p-150 && radius <= 0x1p150; }

/// Whether the radius is proved to be within 1 + tightness of the smallest at all times of the piece.
/// `error`: of control balls.
template <int Dimension>
[[nodiscard]] bool is_proved_tight(const Curves<Dimension>& curves, const CagePiece<Dimension>& piece,
                                   double tightness, double error);

/// What nodes in linear motion are judged by, many at once: the balls, cages and bases at both ends.
template <int Dimension>
struct LinearStep {
  const Balls<Dimension>& start;
  const Balls<Dimension>& end;
  OutwardCages<Dimension> start_cages, end_cages;
  std::span<const Basis> start_bases;
};

/// The nodes that a first look, four at a time, does not prove tight.
template <int Dimension>
void find_loose_nodes(const LinearStep<Dimension>& step, double tightness, std::vector<NodeId>& loose);

}  // namespace kds
