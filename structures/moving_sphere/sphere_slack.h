#pragma once
// How far the balls of a node may wander from where they are before its basis can change: a bound kept for as
// many steps as they stay near, without any certificate. Balls of any radii, that stay as they are, in the
// plane and in space.
//
// Seen from the basis' first ball: centres d_i and radii s_i of the others, z = sum w_i d_i the centre and
// rho the radius, less the first ball's, of the sphere that touches all from outside; T_i = rho - s_i. Let
// every ball move by at most t <= D. Each centre moves by at most 2 (1 - w_i) t as seen from z' = sum w_i
// d_i', which keeps its weights, so its distance from z' is T_i to within v = 2 (1 - min w) t. Twice the
// residuals of z' and rho are differences of two such squared distances less T_i^2, each up to v (2 T + v), T
// the largest. With g_i the gradients of the barycentric coordinates, which add up to zero, the touching
// sphere is at z' + A + (rho' - rho) q where
//   |A| <= K v (T + D),  K = 2 max |sum of some g_i|,  |q| <= sum |g_i s_i| < 1.
// The g_i are rows of a pseudo-inverse P: as the balls move it changes by at most w = sqrt(2) |P| |P'| 2 D
// sqrt(m) (Wedin), |P'| <= |P| / (1 - 2 |P| D sqrt(m)), Frobenius norms; so does each g_i but the first,
// sqrt(m) times that. While the weights are positive the sphere is the smallest, and then its radius changes
// by no more than t; they change by |g_i'| times what the centre moves, which goes on continuously from t =
// 0, where all this holds. So while
//   3 t + |A| + |q| t  <=  rho - s_j - |d_j - z|     for all other balls j,
//   max |g_i'| (|A| + |q| t) < min w,  t < min T
// the basis stays and all others are inside. All bounds are linear in t. In double, with the margins of
// sphere_chord.h for what has been rounded.

#include <span>

#include "motions/base/bead_range.h"
#include "structures/enclosing_sphere/basis.h"
#include "structures/moving_sphere/bead_paths.h"

namespace kds {

/// How far the balls of up to four nodes with bases of one size may move from the start of the step: lower
/// bounds, 0 or below where nothing is proved, and none above what is `wanted` of it.
template <int Dimension>
void sphere_slack(const BeadPaths<Dimension>& paths, std::span<const BeadRange> nodes,
                  std::span<const Basis> bases, std::span<const double> wanted, std::span<double> slack);

}  // namespace kds
