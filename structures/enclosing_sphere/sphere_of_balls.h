#pragma once
// Minimum enclosing spheres of balls of any radii in double, with proved errors: the sphere of a basis, and
// the basis after a ball has escaped. Allocates no memory. A result that is not proved is marked as such.
//
// The sphere that touches the balls from outside is computed first (tangent_sphere). The computed centre z~
// and weights w_i are then verified by their residuals.
//
// F(x) = max_i |c_i - x| + r_i is convex, and its minimum, R at z, is the wanted sphere. Let k_i = |c_i -
// z~| + r_i, K their maximum, S their spread with its rounding, u_i = (c_i - z~) / |c_i - z~| and e = z - z~.
// By convexity K >= R >= k_i - u_i.e, so u_i.e >= -S for all i. The multipliers m_i ~ w_i |c_i - z~|, with
// sum 1, nearly balance: v = sum m_i u_i is small. So u_i.e <= (S + |v||e|) / m_i. Let sigma be the least
// singular value of the matrix of all u_i but the one of greatest m_i. Then |e| <= sqrt(m) (S + |v||e|) /
// (min m_i sigma) =: E', plus O if z~ may have left the span of the centres (sphere_of_points.h). The rest
// follows sphere_of_points.h: |p - z~| + r <= K - 2E proves that a ball is inside.
//
// The basis has no superfluous ball. Without ball j the minimum could stay only if the other u_i at z were
// dependent. Each u_i differs by at most 2E / |c_i - z~| from its value at z~. The u_i are independent if
// sigma_j > 2 sqrt(m) E / min |c_i - z~|, where sigma_j follows from m_j by Cramer's rule.

#include <array>
#include <cmath>

#include "structures/enclosing_sphere/sphere_of_points.h"

namespace kds {

namespace detail {

/// The sphere that touches the balls of a basis from outside, in double, for one basis or for four in lanes.
/// The result has no error bound; the caller verifies it. The equations are those of
/// certificates/types/ball_in_sphere.h: relative to the base, the centre is p + rho q in the span of the
/// other centres, and rho solves a rho^2 + 2 b rho + c = 0.
template <class N, int Dimension, std::size_t M>
struct TangentSphere {
  using Vector = typename Span<N, Dimension, M>::Vector;

  N rho;                        // radius less the base's radius
  Vector center;                // relative to the base
  std::array<N, M + 1> weight;  // barycentric coordinates of the centre, the base's first
  Vector q;                     // derivative of the centre with respect to rho
};

/// `s` holds the radii less the base's radius.
template <class N, int Dimension, std::size_t M>
[[gnu::always_inline]] inline TangentSphere<N, Dimension, M> tangent_sphere(const Span<N, Dimension, M>& span,
                                                                            const std::array<N, M>& s) {
  using Is = NumberTraits<N>;
  TangentSphere<N, Dimension, M> sphere;
  typename Span<N, Dimension, M>::Weights e, yp, yq;
  for (std::size_t i = 0; i < M; ++i) e[i] = N(0.5) * (span.square[i] - s[i] * s[i]);
  const auto p = span.point_of(e, yp);
  sphere.q = span.point_of(s, yq);
  const N a = dot(sphere.q, sphere.q) - N(1.0);
  const N b = dot(p, sphere.q);
  const N c = dot(p, p);
  sphere.rho = c / (Is::sqrt(Is::max(b * b - a * c, N(0.0))) - b);
  sphere.weight[0] = N(1.0);
  for (std::size_t i = 0; i < M; ++i) {
    sphere.weight[i + 1] = yp[i] + sphere.rho * yq[i];
    sphere.weight[0] = sphere.weight[0] - sphere.weight[i + 1];
  }
  for (std::size_t axis = 0; axis < Dimension; ++axis)
    sphere.center[axis] = p[axis] + sphere.rho * sphere.q[axis];
  return sphere;
}

/// Without `bounds`, computes only centre, radius and least weight.
template <bool bounds = true, class N, int Dimension, std::size_t M>
[[gnu::always_inline]] inline BasisSphere<N, Dimension> sphere_of_balls(
    const BasisBalls<N, Dimension, M>& members) {
  using Is = NumberTraits<N>;
  constexpr double u = unit_roundoff;
  const auto balls = from_widest(members);
  const Span<N, Dimension, M> span(balls);
  std::array<N, M> s;
  for (std::size_t i = 0; i < M; ++i) s[i] = balls.radius[i + 1] - balls.radius[0];
  const TangentSphere<N, Dimension, M> tangent = tangent_sphere(span, s);
  const auto& [rho, center, weight, slope] = tangent;
  BasisSphere<N, Dimension> sphere;
  N size(0.0);
  for (std::size_t axis = 0; axis < Dimension; ++axis) {
    sphere.center[axis] = balls.center[0][axis] + center[axis];
    size = Is::max(size, Is::abs(sphere.center[axis]));
  }
  std::array<N, static_cast<std::size_t>(Dimension)> balance;  // sum of weights times c_i - z~
  balance.fill(N(0.0));
  N most(0.0), fewest(HUGE_VAL), near(HUGE_VAL), sum(0.0), weakest(HUGE_VAL), strongest(0.0), product(1.0);
  sphere.least = weight[0];
  for (std::size_t i = 0; i <= M; ++i) {
    const auto d = minus(balls.center[i], sphere.center);
    const N distance = Is::sqrt(dot(d, d));
    const N reach = distance + balls.radius[i];
    most = Is::max(most, reach);
    fewest = Is::min(fewest, reach);
    sphere.least = Is::min(sphere.least, weight[i]);
    if constexpr (!bounds) continue;
    const N pull = weight[i] * distance;
    product = product * distance;
    sum = sum + pull;
    weakest = Is::min(weakest, pull);
    strongest = Is::max(strongest, pull);
    near = Is::min(near, distance);
    for (std::size_t axis = 0; axis < Dimension; ++axis) balance[axis] = balance[axis] + weight[i] * d[axis];
  }
  sphere.radius = most;
  // Written so that NaNs and inconsistent signs prove nothing.
  const auto touches = (rho >= N(0.0)) & (sphere.least > N(0.0)) & (sphere.least <= N(1.0)) &
                       (most - fewest <= N(1e-6) * most);
  sphere.least = Is::choose(touches, sphere.least, N(-1.0));
  if constexpr (!bounds) return sphere;
  N norm = N(32 * u) * sum;  // an upper bound of the balance's length
  for (const N& x : balance) norm = norm + Is::abs(x);
  // The volume of all unit vectors but the one of greatest multiplier: w_i det Q / product of the other
  // distances.
  N volume(1.0);
  if constexpr (M > 1) {
    const N whole = M == 2 ? Is::sqrt(span.determinant) : Is::abs(span.determinant);
    volume = N(0.99) * whole * strongest / product - N(4.0) * norm / near;
  }
  constexpr std::array<double, 4> least_singular{0, 1, 0.7071, 0.6666};  // of M unit vectors of volume 1
  const N sigma = N(least_singular[M]) * volume;
  const N rounding = N(u) * (N(2.0) * size + N(64.0) * most);
  const N left = M < Dimension ? rounding : N(0.0);
  const N balanced = weakest * sigma;
  const N spread = most - fewest + N(32 * u) * most + left;
  const N error = N(2.02 * root_of[M]) * spread * sum / balanced + left;
  sphere.certain = touches & span.sound() & (sigma > N(0.0)) & (most >= N(0x1p-150)) & (most <= N(0x1p150)) &
                   (near >= N(0x1p-200)) & (near > N(4.0) * error) & (error <= N(0x1p-28) * most) &
                   (norm * error <= N(0x1p-46) * most * sum) & (N(4 * root_of[M]) * norm <= balanced) &
                   ((balanced - N(8.0) * norm) * near > N(8 * root_of[M]) * error * strongest);
  sphere.inner = (most - N(2.0) * error) * N(1 - 4 * u);
  sphere.outer =
      Is::choose(sphere.certain, N(8.1) * most * error + N(16.0) * error * error + N(32 * u) * most * most,
                 N(1e-9) * most * most);
  return sphere;
}

template <bool bounds = true, int Dimension>
[[gnu::always_inline]] inline BasisSphere<double, Dimension> sphere_of_balls(
    const BasisBalls<double, Dimension, 0>& balls) {
  constexpr double u = unit_roundoff;
  const double r = balls.radius[0];
  return {balls.center[0], r, r * (1 - 2 * u), 32 * u * r * r, 1, r >= 0x1p-150 && r <= 0x1p150};
}

}  // namespace detail

/// Replaces `basis` by the basis of its balls and `escaped`, which is outside their sphere. Tries likely
/// subsets first, then every subset with `escaped`. The result is likely right but must be verified. Returns
/// false if doubles find none.
template <int Dimension>
[[nodiscard]] bool pivot_balls(const Balls<Dimension>& balls, Basis& basis, BeadId escaped);

}  // namespace kds
