#pragma once
// Questions about faces of a hull at one moment, not certificates: of triangles in space, of edges in the
// plane. Exact; degree 4k in space and 2k in the plane for centres of degree k.

#include <array>
#include <string_view>

#include "certificates/base/certificate.h"
#include "certificates/base/determinant.h"

namespace kds {

/// Normal of the triangle of beads a, b, c, counterclockwise seen from its tip.
template <MotionView View>
[[nodiscard]] auto normal(const View& view, BeadId a, BeadId b, BeadId c) {
  return cross(view.difference(b, a), view.difference(c, a));
}

/// For two faces in one plane (on one line): positive if they turn (run) the same way, zero if one is flat (a
/// point). A face with itself: zero iff it is flat, wherever.
template <int Dimension>
struct SameTurn {
  static constexpr std::string_view name = "same_turn";
  static constexpr std::size_t face = Dimension;
  std::array<BeadId, 2 * face> beads{};  ///< of the one face in their order, then of the other

  template <MotionView View>
  [[nodiscard]] static auto formula(const View& view, const std::array<BeadId, 2 * face>& b) {
    if constexpr (Dimension == 2) {
      return dot(view.difference(b[1], b[0]), view.difference(b[3], b[2]));
    } else {
      return dot(normal(view, b[0], b[1], b[2]), normal(view, b[3], b[4], b[5]));
    }
  }
};

/// In space: positive if the centroid of a triangle lies to the left of the directed line of two beads in its
/// plane, seen from the tip of its normal; zero if on the line. In the plane: positive if the middle of an
/// edge lies beyond a bead on its line, in the edge's direction.
template <int Dimension>
struct CentroidInside {
  static constexpr std::string_view name = "centroid_inside";
  static constexpr std::size_t face = Dimension;
  std::array<BeadId, 2 * face - 1> beads{};  ///< of the face in their order, then the line's (the bead)

  template <MotionView View>
  [[nodiscard]] static auto formula(const View& view, const std::array<BeadId, 2 * face - 1>& b) {
    const BeadId p = b[face];
    auto from_p = view.difference(b[0], p);  // `face` times the centroid, seen from p
    for (std::size_t i = 1; i < face; ++i) {
      const auto d = view.difference(b[i], p);
      for (std::size_t axis = 0; axis < from_p.size(); ++axis) from_p[axis] += d[axis];
    }
    if constexpr (Dimension == 2) {
      return dot(view.difference(b[1], b[0]), from_p);
    } else {
      return dot(normal(view, b[0], b[1], b[2]), cross(view.difference(b[4], p), from_p));
    }
  }
};

}  // namespace kds
