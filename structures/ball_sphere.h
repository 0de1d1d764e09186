#pragma once
// Minimum enclosing spheres of balls of any radii in double, with proved errors: the sphere of a basis, and
// the basis after a ball has escaped. No allocation; what is not proved says so.
//
// The sphere that touches the balls from outside is put together as certificates/ball_in_sphere.h says; then
// centre z~ and weights w_i are judged by what they do. F(x) = max_i |c_i - x| + r_i is convex, and its
// minimum, R at z, is the sphere sought. With k_i = |c_i - z~| + r_i, K their maximum, S their spread with
// its rounding, u_i = (c_i - z~) / |c_i - z~| and e = z - z~, convexity gives K >= R >= k_i - u_i.e, that is
// u_i.e >= -S for all i. The multipliers m_i ~ w_i |c_i - z~|, with sum 1, nearly balance: v = sum m_i u_i is
// small. So u_i.e <= (S + |v||e|) / m_i, and for the matrix of all u_i but the one of greatest m_i, least
// singular value sigma, |e| <= sqrt(m) (S + |v||e|) / (min m_i sigma) =: E', plus O where z~ may have left
// the span of the centres (point_sphere.h). From here on as there: |p - z~| + r <= K - 2E proves that a ball
// is inside. The basis has no ball to spare: without ball j the minimum could stay only if the other u_i at
// z, each within 2E / |c_i - z~| of what it is at z~, were dependent, and they are not if sigma_j > 2 sqrt(m)
// E / min |c_i - z~|, where sigma_j follows from m_j by Cramer's rule.

#include "structures/point_sphere.h"

namespace kds {

namespace detail {

/// The volume that M unit vectors span, all but one of M + 1; an absolute error of 32u is taken off.
template <std::size_t LeftOut, class N, std::size_t Size, std::size_t Count>
[[gnu::always_inline]] inline N volume_of(const std::array<std::array<N, Size>, Count>& units) {
  using Is = NumberTraits<N>;
  constexpr auto place = [](std::size_t i) { return i < LeftOut ? i : i + 1; };
  if constexpr (Count == 2) {
    return N(1.0);
  } else if constexpr (Size == 2) {
    const auto &a = units[place(0)], &b = units[place(1)];
    return Is::abs(a[0] * b[1] - a[1] * b[0]) - N(32 * unit_roundoff);
  } else {
    const auto normal = cross(units[place(0)], units[place(1)]);
    if constexpr (Count == 3)
      return Is::sqrt(dot(normal, normal)) - N(32 * unit_roundoff);
    else
      return Is::abs(dot(normal, units[place(2)])) - N(32 * unit_roundoff);
  }
}

/// Without `bounds` only centre, radius and least weight.
template <bool bounds = true, class N, int Dimension, std::size_t M>
[[gnu::always_inline]] inline BasisSphere<N, Dimension> sphere_of_balls(
    const BasisBalls<N, Dimension, M>& balls) {
  using Is = NumberTraits<N>;
  constexpr double u = unit_roundoff;
  const Span<N, Dimension, M> span(balls);
  std::array<N, M> s, e;
  for (std::size_t i = 0; i < M; ++i) {
    s[i] = balls.radius[i + 1] - balls.radius[0];
    e[i] = N(0.5) * (span.square[i] - s[i] * s[i]);
  }
  // The centre is p + rho q, seen from the base.
  typename Span<N, Dimension, M>::Weights yp, yq;
  const auto p = span.point_of(e, yp);
  const auto q = span.point_of(s, yq);
  const N a = dot(q, q) - N(1.0);
  const N b = dot(p, q);
  const N c = dot(p, p);
  const N rho = c / (Is::sqrt(Is::max(b * b - a * c, N(0.0))) - b);
  BasisSphere<N, Dimension> sphere;
  std::array<N, M + 1> weight;
  weight[0] = N(1.0);
  for (std::size_t i = 0; i < M; ++i) {
    weight[i + 1] = yp[i] + rho * yq[i];
    weight[0] = weight[0] - weight[i + 1];
  }
  N size(0.0);
  for (std::size_t axis = 0; axis < Dimension; ++axis) {
    sphere.center[axis] = balls.center[0][axis] + (p[axis] + rho * q[axis]);
    size = Is::max(size, Is::abs(sphere.center[axis]));
  }
  std::array<std::array<N, static_cast<std::size_t>(Dimension)>, M + 1> units;
  std::array<N, static_cast<std::size_t>(Dimension)> balance;
  balance.fill(N(0.0));
  N most(0.0), fewest(HUGE_VAL), near(HUGE_VAL), sum(0.0), weakest(HUGE_VAL), strongest(0.0);
  sphere.least = weight[0];
  N volume(0.0);
  for (std::size_t i = 0; i <= M; ++i) {
    units[i] = minus(balls.center[i], sphere.center);
    const N distance = Is::sqrt(dot(units[i], units[i]));
    const N reach = distance + balls.radius[i];
    const N pull = weight[i] * distance;
    sum = sum + pull;
    weakest = Is::min(weakest, pull);
    strongest = Is::max(strongest, pull);
    most = Is::max(most, reach);
    fewest = Is::min(fewest, reach);
    near = Is::min(near, distance);
    sphere.least = Is::min(sphere.least, weight[i]);
    const N over = N(1.0) / distance;
    for (std::size_t axis = 0; axis < Dimension; ++axis) {
      balance[axis] = balance[axis] + weight[i] * units[i][axis];
      units[i][axis] = units[i][axis] * over;
    }
  }
  // The greatest volume belongs to leaving out the strongest.
  volume = volume_of<0>(units);
  if constexpr (M >= 2) volume = Is::max(Is::max(volume, volume_of<1>(units)), volume_of<2>(units));
  if constexpr (M == 3) volume = Is::max(volume, volume_of<3>(units));
  constexpr std::array<double, 4> least_singular{0, 1, 0.7071, 0.6666};  // of a unit volume
  const N sigma = N(least_singular[M]) * volume;
  sphere.radius = most;
  const N rounding = N(u) * (N(2.0) * size + N(64.0) * most);
  const N left = M < Dimension ? rounding : N(0.0);
  const N unbalanced = Is::sqrt(dot(balance, balance)) / sum + N(32 * u);
  const N balanced = weakest / sum * sigma;
  const N spread = most - fewest + N(32 * u) * most + left;
  const N error = N(2.02 * root_of[M]) * spread / balanced + left;
  // Written so that NaNs and signs that make no sense are no proof.
  const auto touches = (rho >= N(0.0)) & (sphere.least > N(0.0)) & (sphere.least <= N(1.0)) & (sum > N(0.0)) &
                       (most - fewest <= N(1e-6) * most);
  sphere.least = Is::choose(touches, sphere.least, N(-1.0));
  sphere.certain =
      touches & (sigma > N(0.0)) & (most >= N(0x1p-150)) & (most <= N(0x1p150)) & (near >= N(0x1p-200)) &
      (near > N(4.0) * error) & (error <= N(0x1p-28) * most) & (unbalanced * error <= N(0x1p-46) * most) &
      (N(4 * root_of[M]) * unbalanced <= balanced) &
      ((weakest * sigma - N(8.0) * unbalanced * sum) * near > N(8 * root_of[M]) * error * strongest);
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

/// The basis of the balls of a basis and `escaped`, which is outside their sphere. Tries what is likely, then
/// every subset with `escaped`. Likely right: to be verified. False if double finds none.
template <int Dimension>
[[nodiscard]] bool pivot_balls(const Balls<Dimension>& balls, Basis& basis, BeadId escaped);

}  // namespace kds
