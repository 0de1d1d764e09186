#pragma once
// The sphere around two balls of which neither holds the other, in double, for one pair or for four in lanes.

#include "structures/enclosing_sphere/sphere_of_points.h"

namespace kds::detail {

template <class N, int Dimension>
struct PairSphere {
  std::array<N, static_cast<std::size_t>(Dimension)> center;
  N radius;
  typename NumberTraits<N>::Flag certain;  // both balls are in the basis
  typename NumberTraits<N>::Flag loose;    // the centre lost digits because it is far from the origin
};

/// If `of_points`, radii are ignored.
template <bool of_points, int Dimension, class N>
[[gnu::always_inline]] inline PairSphere<N, Dimension> sphere_of_pair(
    const BasisBalls<N, Dimension, 1>& pair) {
  using Is = NumberTraits<N>;
  PairSphere<N, Dimension> sphere;
  auto half = minus(pair.center[1], pair.center[0]);
  for (N& x : half) x = N(0.5) * x;
  const N apart = Is::sqrt(dot(half, half));
  sphere.radius = apart;
  N share(1.0), larger(0.0);
  if constexpr (!of_points) {
    const N a = pair.radius[0], b = pair.radius[1];
    share = share + N(0.5) * (b - a) / apart;
    sphere.radius = apart + N(0.5) * (a + b);
    larger = Is::max(a, b);
  }
  N size(0.0);
  for (std::size_t axis = 0; axis < Dimension; ++axis) {
    sphere.center[axis] = pair.center[0][axis] + share * half[axis];
    size = Is::max(size, Is::abs(sphere.center[axis]));
  }
  sphere.certain = (sphere.radius >= N(0x1p-150)) & (sphere.radius <= N(0x1p150));
  // The radius exceeds both radii by more than its error.
  if constexpr (!of_points) sphere.certain = sphere.certain & (sphere.radius > larger * N(1 + 0x1p-40));
  sphere.loose = size * N(0x1p-22) > sphere.radius;
  return sphere;
}

}  // namespace kds::detail
