#pragma once
// Functions of beads that lie in one plane at the time asked for. Not certificates: questions about one
// moment. Exact; degree 4k for centres of degree k.

#include "certificates/certificate.h"
#include "certificates/determinant.h"

namespace kds {

/// Normal of the triangle of beads a, b, c, counterclockwise seen from its tip.
template <MotionView View>
[[nodiscard]] auto normal(const View& view, BeadId a, BeadId b, BeadId c) {
  return cross(view.difference(b, a), view.difference(c, a));
}

/// Positive if two triangles turn the same way, zero if one of them is flat.
struct SameTurn {
  std::array<BeadId, 6> beads{};  ///< three of the one triangle in their order, three of the other

  template <MotionView View>
  [[nodiscard]] static auto formula(const View& view, const std::array<BeadId, 6>& beads) {
    return dot(normal(view, beads[0], beads[1], beads[2]), normal(view, beads[3], beads[4], beads[5]));
  }
};

/// Positive if the centroid of a triangle lies to the left of the directed line of two beads, seen from the
/// tip of the triangle's normal; zero if on it.
struct CentroidLeftOf {
  std::array<BeadId, 5> beads{};  ///< three of the triangle in their order, two of the line

  template <MotionView View>
  [[nodiscard]] static auto formula(const View& view, const std::array<BeadId, 5>& beads) {
    const auto& [a, b, c, p, q] = beads;
    auto from_p = view.difference(a, p);  // three times the centroid, seen from p
    for (const BeadId other : {b, c}) {
      const auto d = view.difference(other, p);
      for (std::size_t axis = 0; axis < from_p.size(); ++axis) from_p[axis] += d[axis];
    }
    return dot(normal(view, a, b, c), cross(view.difference(q, p), from_p));
  }
};

}  // namespace kds
