#pragma once
// Queries about faces of a hull at one moment; they are not certificates. Faces are triangles in space and
// edges in the plane. Exact; degree 4k in space and 2k in the plane for centres of degree k.

#include <array>
#include <string_view>

#include "certificates/base/certificate.h"
#include "certificates/base/determinant.h"

namespace kds {

/// Returns the normal of the triangle of beads a, b, c, which are counterclockwise seen from the tip of the
/// normal.
template <MotionView View>
[[nodiscard]] auto normal(const View& view, BeadId a, BeadId b, BeadId c) {
  return cross(view.difference(b, a), view.difference(c, a));
}

/// For two faces in one plane (on one line): positive if they have the same orientation (direction), zero if
/// one of them is degenerate. For a face and itself, in any position: zero iff it is degenerate.
template <int Dimension>
struct SameTurn {
  static constexpr std::string_view name = "same_turn";
  static constexpr std::size_t face = Dimension;
  std::array<BeadId, 2 * face> beads{};  ///< one face's beads in their order, then the other's

  template <MotionView View>
  [[nodiscard]] static auto formula(const View& view, const std::array<BeadId, 2 * face>& b) {
    if constexpr (Dimension == 2) {
      return dot(view.difference(b[1], b[0]), view.difference(b[3], b[2]));
    } else {
      return dot(normal(view, b[0], b[1], b[2]), normal(view, b[3], b[4], b[5]));
    }
  }
};

/// In space: the position of a triangle's centroid relative to the directed line of two beads in the
/// triangle's plane, seen from the tip of its normal. Positive if the centroid is to the left, zero if it is
/// on the line. In the plane: positive if the midpoint of an edge lies beyond a bead on its line, in the
/// edge's direction.
template <int Dimension>
struct CentroidInside {
  static constexpr std::string_view name = "centroid_inside";
  static constexpr std::size_t face = Dimension;
  std::array<BeadId, 2 * face - 1> beads{};  ///< the face's in their order, then the line's (the bead)

  template <MotionView View>
  [[nodiscard]] static auto formula(const View& view, const std::array<BeadId, 2 * face - 1>& b) {
    const BeadId p = b[face];
    auto from_p = view.difference(b[0], p);  // `face` times the centroid, relative to p
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
