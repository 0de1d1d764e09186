#pragma once
// Computes how far the balls of a node may move from their positions before the node's basis can change. The
// bound stays valid, without certificates, for as many steps as the balls stay that near. For balls of any
// constant radii, in the plane and in space.
//
// All positions are relative to the basis' first ball: centres d_i and radii s_i of the others. Let z = sum
// w_i d_i be the centre and rho the radius, less the first ball's, of the sphere that touches all balls from
// outside, and T_i = rho - s_i. Let every ball move by at most t <= D. Relative to z' = sum w_i d_i', which
// keeps its weights, each centre moves by at most 2 (1 - w_i) t. The distance of each centre from z' is
// therefore T_i to within v = 2 (1 - min w) t.
//
// Twice the residuals of z' and rho are differences of two such squared distances less T_i^2, each up to v
// (2 T + v), where T is the largest T_i. Let g_i be the gradients of the barycentric coordinates, which sum
// to zero. The touching sphere is at z' + A + (rho' - rho) q, where
//
//   |A| <= K v (T + D),  K = 2 max |sum of some g_i|,  |q| <= sum |g_i s_i| < 1.
//
// The g_i are rows of a pseudo-inverse P. As the balls move, P changes by at most w = sqrt(2) |P| |P'| 2 D
// sqrt(m) (Wedin), |P'| <= |P| / (1 - 2 |P| D sqrt(m)), in Frobenius norms. So does each g_i but the first,
// which changes by at most sqrt(m) times that. While the weights are positive, the sphere is the minimum
// enclosing one, and its radius changes by at most t. The weights change by at most |g_i'| times the movement
// of the centre, which continues from t = 0, where all this holds. So while
//
//   3 t + |A| + |q| t  <=  rho - s_j - |d_j - z|     for all other balls j,
//   max |g_i'| (|A| + |q| t) < min w,  t < min T
//
// the basis stays and all other balls are inside. All bounds are linear in t. Computed in double, with the
// margins of sphere_chord.h for rounding.

#include <span>

#include "motions/base/bead_range.h"
#include "structures/enclosing_sphere/basis.h"
#include "structures/moving_sphere/bead_paths.h"

namespace kds {

/// Computes how far the balls of up to four nodes with bases of one size may move from the start of the step.
/// The results are lower bounds; a result of 0 or below means that nothing is proved. No result exceeds
/// `wanted`.
template <int Dimension>
void sphere_slack(const BeadPaths<Dimension>& paths, std::span<const BeadRange> nodes,
                  std::span<const Basis> bases, std::span<const double> wanted, std::span<double> slack);

}  // namespace kds
