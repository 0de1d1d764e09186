#pragma once
// Nodes of a static wrapped hierarchy in four lanes: the balls of their bases, and a fast path for nodes of
// two beads. Half of all nodes have two beads, and usually both beads stay the basis.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "structures/enclosing_sphere/cage.h"
#include "structures/enclosing_sphere/sphere_of_points.h"
#include "structures/necklace/necklace_tree.h"

namespace kds::detail {

/// The sphere around two balls of which neither holds the other, in double, for one pair or for four in
/// lanes.
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

template <int Dimension, std::size_t M>
[[gnu::always_inline]] inline void set_ball(BasisBalls<Lanes, Dimension, M>& members, std::size_t j,
                                            const FourBalls<Dimension>& four) {
  // Assigned lane by lane: g++ 12 would copy whole arrays in halves, and later loads would stall on them.
  for (std::size_t axis = 0; axis < Dimension; ++axis) members.center[j][axis].v = four.center[axis].v;
  members.radius[j].v = four.radius.v;
}

/// Loads the balls of the bases of four nodes, with M + 1 balls each.
template <int Dimension, std::size_t M>
[[gnu::always_inline]] inline void gather(const BallRow<Dimension>* rows, const Basis* bases,
                                          const FourIndices& nodes,
                                          BasisBalls<Lanes, Dimension, M>& members) {
  for (std::size_t j = 0; j <= M; ++j)
    set_ball(members, j,
             FourBalls<Dimension>(rows, {bases[nodes[0]].beads[j], bases[nodes[1]].beads[j],
                                         bases[nodes[2]].beads[j], bases[nodes[3]].beads[j]}));
}

/// Computes the cages of nodes of two beads and keeps in the list only the nodes that need more work: both
/// beads were not the basis, or may not be any more. All other nodes get their cages, which are not loose.
/// The cage and flag of a kept node are undefined.
template <bool of_points, int Dimension>
[[KDS_LANES_TARGETS]] std::size_t keep_pairs(const NodeId* nodes, std::size_t count, const BeadRange* ranges,
                                             const BallRow<Dimension>* rows, const Basis* bases,
                                             Cage<Dimension>* cages, std::uint8_t* loose, NodeId* left) {
  std::size_t lefts = 0;
  for (std::size_t i = 0; i < count; i += Lanes::width) {
    FourIndices first, last, wrapped;
    bool both = true;
    for (std::size_t lane = 0; lane < Lanes::width; ++lane) {
      const NodeId node = nodes[std::min(i + lane, count - 1)];
      first[lane] = ranges[node].first;
      last[lane] = ranges[node].last;
      wrapped[lane] = node;
      loose[node] = 0;
      both &= bases[node].size == 2;
    }
    BasisBalls<Lanes, Dimension, 1> members;
    set_ball(members, 0, FourBalls<Dimension>(rows, first));
    set_ball(members, 1, FourBalls<Dimension>(rows, last));
    const auto sphere = sphere_of_pair<of_points, Dimension, Lanes>(members);
    FourBalls<Dimension> spheres;
    for (std::size_t axis = 0; axis < Dimension; ++axis) spheres.center[axis].v = sphere.center[axis].v;
    spheres.radius.v = sphere.radius.v;
    spheres.store(cages, wrapped);
    const Lanes::Mask kept = sphere.certain & ~sphere.loose;
    if (both && Lanes::all(kept)) continue;
    for (std::size_t lane = 0; lane < std::min(Lanes::width, count - i); ++lane)
      if (kept[lane] == 0 || bases[nodes[i + lane]].size != 2) left[lefts++] = nodes[i + lane];
  }
  return lefts;
}

}  // namespace kds::detail
