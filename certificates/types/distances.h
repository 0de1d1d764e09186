#pragma once
// Certificates about distances of beads. Exact; degree 2k for centres and radii of degree k.

#include <algorithm>
#include <array>
#include <cstddef>

#include "certificates/base/certificate.h"
#include "certificates/base/certificate_type.h"
#include "certificates/base/constants.h"
#include "certificates/types/shifted_difference.h"

namespace kds {

/// Compares two pairs of beads: the centres of the first pair are closer together than those of the second,
/// |c - d|^2 - |a - b|^2 > 0. In a periodic cell, the second bead of a pair may be moved by a shift, given
/// exactly as the difference of two points (shifted_beads.h).
struct Closer {
  static constexpr CertificateType type{12, "closer"};
  static constexpr int lanes_up_to_degree = 3;

  struct Pair {
    std::array<BeadId, 2> beads{};  ///< ascending
    std::array<BeadId, 2> shift =
        no_shift;  ///< the points `to` and `from` of the second bead's shift to - from
    friend auto operator<=>(const Pair&, const Pair&) = default;
  };
  static constexpr std::array<BeadId, 2> no_shift{no_bead, no_bead};

  /// The lesser pair and the shift of its second bead, then the other pair and its shift. Without a shift, a
  /// bead takes the place of both points. The pairs may share beads.
  std::array<BeadId, 8> beads{};
  int sign = 1;

  Closer() = default;
  /// Holds while the first pair is closer.
  Closer(const Pair& near, const Pair& far) : sign(near < far ? 1 : -1) {
    std::size_t at = 0;
    for (const Pair& pair : {std::min(near, far), std::max(near, far)}) {
      for (const BeadId bead : pair.beads) beads[at++] = bead;
      for (const BeadId point : pair.shift) beads[at++] = point == no_bead ? pair.beads[0] : point;
    }
  }

  [[nodiscard]] Identity identity() const {
    Identity identity = identity_of(type, std::array<BeadId, 4>{beads[0], beads[1], beads[4], beads[5]});
    // Messages name the beads before the first `no_bead`; the shifts follow it, to tell images apart.
    if (beads[2] != beads[3]) identity.beads[5] = beads[2];
    if (beads[6] != beads[7]) identity.beads[6] = beads[6];
    return identity;
  }

  [[nodiscard]] bool side() const { return sign > 0; }

  template <MotionView View>
  [[nodiscard]] static auto formula(const View& view, const std::array<BeadId, 8>& beads) {
    const auto lesser = shifted_difference(view, beads[1], beads[0], beads[2], beads[3]);
    const auto greater = shifted_difference(view, beads[5], beads[4], beads[6], beads[7]);
    return dot(greater, greater) - dot(lesser, lesser);
  }
};

/// Contact of two balls: |c_i - c_j|^2 - (r_i + r_j)^2 is positive while they are disjoint, zero while they
/// touch, and negative while they overlap. Radii may change, but the sum of both must not be negative.
struct Contact {
  static constexpr CertificateType type{4, "contact"};
  static constexpr int lanes_up_to_degree = 3;
  static constexpr bool uses_radii = true;

  std::array<BeadId, 2> beads{};  ///< ascending
  int sign = 1;

  Contact() = default;
  /// Holds while the balls are disjoint, or, if `sign_wanted` is -1, while they overlap.
  Contact(std::array<BeadId, 2> in_any_order, int sign_wanted) : beads(in_any_order), sign(sign_wanted) {
    static_cast<void>(sort_beads(beads));
  }

  [[nodiscard]] Identity identity() const { return identity_of(type, beads); }

  [[nodiscard]] bool side() const { return sign > 0; }

  template <MotionView View>
  [[nodiscard]] static auto formula(const View& view, const std::array<BeadId, 2>& beads) {
    const auto d = view.difference(beads[1], beads[0]);
    const auto reach = view.radius_sum(beads[1], beads[0]);
    return dot(d, d) - reach * reach;
  }
};

/// Contact of a ball with an image of another one in a periodic cell. The image is moved by a shift, which is
/// given exactly as the difference of two points (shifted_beads.h). Like Contact otherwise.
struct ImageContact {
  static constexpr CertificateType type{15, "image_contact"};
  static constexpr int lanes_up_to_degree = 3;
  static constexpr bool uses_radii = true;

  /// The two beads, ascending, and the points `to` and `from` of the second bead's shift to - from.
  std::array<BeadId, 4> beads{};
  int sign = 1;

  [[nodiscard]] Identity identity() const {
    return identity_with_shift(type, std::array{beads[0], beads[1]}, beads[2], beads[3]);
  }

  [[nodiscard]] bool side() const { return sign > 0; }

  template <MotionView View>
  [[nodiscard]] static auto formula(const View& view, const std::array<BeadId, 4>& beads) {
    const auto d = shifted_difference(view, beads[1], beads[0], beads[2], beads[3]);
    const auto reach = view.radius_sum(beads[1], beads[0]);
    return dot(d, d) - reach * reach;
  }
};

/// Compares the distance of two centres with a length: |c_i - c_j|^2 - length^2 is positive while they are
/// further apart.
struct DistanceBeyond {
  static constexpr CertificateType type{25, "distance_beyond"};
  struct Constants {
    Constant<1> length;
  };

  std::array<BeadId, 2> beads{};  ///< ascending
  int sign = 1;

  DistanceBeyond() = default;
  /// Holds while the centres are at least that far apart, or, if `sign_wanted` is -1, at most that far.
  DistanceBeyond(std::array<BeadId, 2> in_any_order, int sign_wanted)
      : beads(in_any_order), sign(sign_wanted) {
    static_cast<void>(sort_beads(beads));
  }

  [[nodiscard]] Identity identity() const { return identity_of(type, beads); }

  [[nodiscard]] bool side() const { return sign > 0; }

  template <MotionView View>
  [[nodiscard]] static auto formula(const View& view, const std::array<BeadId, 2>& beads) {
    const auto d = view.difference(beads[1], beads[0]);
    const auto length = view.constant(&Constants::length);
    return dot(d, d) - length * length;
  }
};

}  // namespace kds
