#pragma once
// Certificates about the simplices of a dual complex. Beads are balls around their centres whose squared
// radii are the weights. The size of a simplex is the power of the smallest sphere that is orthogonal to all
// of its balls: its squared radius. If the size is negative, the balls have a common interior point. Sizes
// grow from a face to a simplex. Formulas: Edelsbrunner, "Weighted alpha shapes", 1992; Edelsbrunner and
// Muecke, "Three-dimensional alpha shapes", 1994.
//
// For beads p_0, ..., p_k let a_i = p_i - p_0, G the Gram matrix of the a_i, and b_i = |a_i|^2 - w_i + w_0.
// The sphere's centre is p_0 + sum y_i a_i with G y = b / 2, and the size is b^T G^-1 b / 4 - w_0. Both are
// computed without divisions, multiplied by 4 det G or by det G, which are positive for independent a_i.

#include <array>
#include <cstddef>
#include <string_view>

#include "certificates/base/certificate.h"
#include "certificates/base/certificate_type.h"
#include "certificates/base/determinant.h"

namespace kds {

/// The a_i and b_i of a simplex of N beads.
template <MotionView View, std::size_t N>
struct EdgesAndLifts {
  std::array<BernsteinVector<typename View::Number, View::degree, View::dimension>, N - 1> edges;
  std::array<Bernstein<typename View::Number, 2 * View::degree>, N - 1> lifts;
};
template <MotionView View, std::size_t N>
[[nodiscard, gnu::always_inline]] inline EdgesAndLifts<View, N> edges_and_lifts(
    const View& view, const std::array<BeadId, N>& beads) {
  EdgesAndLifts<View, N> of;
  for (std::size_t i = 0; i < N - 1; ++i) {
    of.edges[i] = view.difference(beads[i + 1], beads[0]);
    of.lifts[i] = dot(of.edges[i], of.edges[i]) -
                  elevate<2 * View::degree>(view.weight_difference(beads[i + 1], beads[0]));
  }
  return of;
}

/// Returns b_1 (a_2 x a_3) + b_2 (a_3 x a_1) + b_3 (a_1 x a_2): the centre of the sphere orthogonal to a
/// tetrahedron's balls, seen from p_0, times twice the determinant of a_1, a_2, a_3.
template <class Number, int Degree, int Lift>
[[nodiscard, gnu::always_inline]] inline auto orthogonal_centre(
    const std::array<BernsteinVector<Number, Degree, 3>, 3>& a,
    const std::array<Bernstein<Number, Lift>, 3>& b) {
  const auto first = cross(a[1], a[2]), second = cross(a[2], a[0]), third = cross(a[0], a[1]);
  const auto at = [&](std::size_t axis) {
    return b[0] * first[axis] + b[1] * second[axis] + b[2] * third[axis];
  };
  return std::array{at(0), at(1), at(2)};
}

/// The size of a simplex of N beads. Exact. For centres and weights of degree k, the degree is k for a
/// vertex, 4k for an edge, 6k for a triangle and 8k for a tetrahedron.
template <std::size_t N>
struct SimplexSize {
  static_assert(1 <= N && N <= 4);
  static constexpr std::array<CertificateType, 4> types{
      {{21, "vertex_size"}, {22, "edge_size"}, {23, "triangle_size"}, {24, "tetrahedron_size"}}};
  static constexpr CertificateType type = types[N - 1];
  static constexpr int lanes_up_to_degree = N == 1 ? 0 : 1;
  static constexpr bool uses_weights = true, suits_lifted_motion = false;

  std::array<BeadId, N> beads{};  ///< ascending
  int sign = 1;

  SimplexSize() = default;
  /// Holds while `sign_wanted` times the size is positive.
  SimplexSize(std::array<BeadId, N> in_any_order, int sign_wanted) : beads(in_any_order), sign(sign_wanted) {
    static_cast<void>(sort_beads(beads));
  }

  [[nodiscard]] Identity identity() const { return identity_of(type, beads); }

  [[nodiscard]] bool side() const { return sign > 0; }

  template <MotionView View>
  [[nodiscard]] static auto formula(const View& view, const std::array<BeadId, N>& beads) {
    if constexpr (N == 1) {
      return -view.weight(beads[0]);
    } else {
      const auto [a, b] = edges_and_lifts(view, beads);
      const auto four_weights = times(4, elevate<2 * View::degree>(view.weight(beads[0])));
      if constexpr (N == 2) {
        return b[0] * b[0] - four_weights * dot(a[0], a[0]);
      } else if constexpr (N == 3) {
        const auto g11 = dot(a[0], a[0]), g12 = dot(a[0], a[1]), g22 = dot(a[1], a[1]);
        return b[0] * b[0] * g22 - times(2, b[0] * b[1] * g12) + b[1] * b[1] * g11 -
               four_weights * (g11 * g22 - g12 * g12);
      } else {
        const auto centre = orthogonal_centre(a, b);
        const auto volume = determinant(a[0], a[1], a[2]);
        return dot(centre, centre) - four_weights * (volume * volume);
      }
    }
  }
};

/// Query, not a certificate: tells on which side of the other beads the orthogonal sphere of N beads is
/// centred, by the sign of the last bead's barycentric coordinate of the centre. It is negative iff that bead
/// conflicts with the smallest orthogonal sphere of the others (its power to the centre is less than their
/// size): their simplex is then attached to this one. Exact; degree 2k, 4k, 6k for 2, 3, 4 beads.
template <std::size_t N>
struct CentreSide {
  static_assert(2 <= N && N <= 4);
  static constexpr std::string_view name = "centre_side";
  static constexpr bool uses_weights = true, suits_lifted_motion = false;

  std::array<BeadId, N> beads{};

  template <MotionView View>
  [[nodiscard]] static auto formula(const View& view, const std::array<BeadId, N>& beads) {
    const auto [a, b] = edges_and_lifts(view, beads);
    if constexpr (N == 2) {
      return b[0];
    } else if constexpr (N == 3) {
      return dot(a[0], a[0]) * b[1] - dot(a[0], a[1]) * b[0];
    } else {
      return dot(orthogonal_centre(a, b), cross(a[0], a[1]));
    }
  }
};

}  // namespace kds
