#pragma once
// The orientation of beads, and queries about faces of a hull. Exact.

#include <array>
#include <string_view>

#include "certificates/base/certificate.h"
#include "certificates/base/certificate_type.h"
#include "certificates/base/determinant.h"

namespace kds {

/// The orientation of beads (CGAL's conventions). In the plane, for beads p, q, r: the sign of det[q-p, r-p],
/// positive if they turn counterclockwise. In space, for p, q, r, s: the sign of det[q-p, r-p, s-p], positive
/// if p, q, r turn counterclockwise seen from s. Antisymmetric in its beads; zero iff the beads are collinear
/// (coplanar). Degree 2k (3k) for centres of degree k.
template <int Dimension>
struct Orientation {
  static_assert(Dimension == 2 || Dimension == 3);
  static constexpr CertificateType type{1, "orientation"};
  static constexpr int lanes_up_to_degree = 3;
  static constexpr std::size_t size = Dimension + 1;

  std::array<BeadId, size> beads{};  ///< ascending
  int sign = 1;

  Orientation() = default;
  /// Holds while `sign_wanted` times the orientation of the beads in this order is positive.
  Orientation(std::array<BeadId, size> in_order, int sign_wanted) : beads(in_order) {
    sign = sign_wanted * sort_beads(beads);
  }

  [[nodiscard]] Identity identity() const { return identity_of(type, beads); }

  [[nodiscard]] bool side() const { return sign > 0; }

  template <MotionView View>
  [[nodiscard]] static auto formula(const View& view, const std::array<BeadId, size>& beads) {
    const auto a = view.difference(beads[1], beads[0]);
    const auto b = view.difference(beads[2], beads[0]);
    if constexpr (Dimension == 2) {
      return minor(a[0], a[1], b[0], b[1]);
    } else {
      return determinant(a, b, view.difference(beads[3], beads[0]));
    }
  }
};

// Queries about faces of a hull at one moment; they are not certificates. Faces are triangles in space and
// edges in the plane. Degree 4k in space and 2k in the plane for centres of degree k.

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
