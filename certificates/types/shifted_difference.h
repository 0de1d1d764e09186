#pragma once
// Shifts in certificates about images in a periodic cell. A shift is given exactly as the difference of two
// points, `to - from` (shifted_beads.h).

#include <array>
#include <cstddef>

#include "certificates/base/certificate.h"
#include "certificates/base/certificate_type.h"

namespace kds {

/// Returns q + (to - from) - p.
template <MotionView View>
[[nodiscard]] auto shifted_difference(const View& view, BeadId q, BeadId p, BeadId to, BeadId from) {
  auto difference = view.difference(q, p);
  const auto shift = view.difference(to, from);
  for (std::size_t axis = 0; axis < difference.size(); ++axis) difference[axis] += shift[axis];
  return difference;
}

/// Returns the identity of a certificate on at most four beads and a shift. Messages name the beads before
/// the first `no_bead`; the shift follows it, to tell images apart.
template <std::size_t N>
[[nodiscard]] constexpr Identity identity_with_shift(const CertificateType& type,
                                                     const std::array<BeadId, N>& beads, BeadId to,
                                                     BeadId from) {
  static_assert(N <= 4);
  Identity identity = identity_of(type, beads);
  if (to != from) identity.beads[N + 1] = to;
  return identity;
}

}  // namespace kds
