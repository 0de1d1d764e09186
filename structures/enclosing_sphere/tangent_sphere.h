#pragma once
// The sphere that touches the balls of a basis from outside, in double, for one basis or for four in lanes.
// The result has no error bound; the caller verifies it. The equations are those of
// certificates/types/ball_in_sphere.h: relative to the base, the centre is p + rho q in the span of the other
// centres, and rho solves a rho^2 + 2 b rho + c = 0.

#include "structures/enclosing_sphere/sphere_of_points.h"

namespace kds::detail {

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

}  // namespace kds::detail
