#pragma once
// Selects the certificate that a ball lies in the sphere of a basis. If the radii involved are equal during
// the whole step, the selected certificate is the one for equal radii, also for beads of an unequal necklace.
// Otherwise the radical certificate is selected. The plane and space are supported. The two types are exact;
// the types in their identities distinguish them.
//
//   equal radii    bases of 1, 2 and (in space) 3 beads: bead_in_sphere.h; full bases: a power test times the
//                  basis' orientation, where the weights are equal too
//   others         ball_in_sphere.h

#include <algorithm>
#include <array>
#include <concepts>
#include <span>

#include "certificates/base/radical.h"
#include "certificates/types/ball_in_sphere.h"
#include "certificates/types/bead_in_sphere.h"
#include "certificates/types/power_test.h"

namespace kds {

namespace detail {

/// Returns whether `value(bead, k)` is the same for all of these beads, for every control point k.
template <std::invocable<BeadId, int> Value>
[[nodiscard]] bool all_equal(std::span<const BeadId> beads, int degree, Value value) {
  return std::all_of(beads.begin(), beads.end(), [&](BeadId bead) {
    for (int k = 0; k <= degree; ++k) {
      if (value(bead, k) != value(beads.front(), k)) return false;
    }
    return true;
  });
}

template <std::size_t N>
[[nodiscard]] std::array<BeadId, N + 1> with_bead(std::span<const BeadId> basis, BeadId bead) {
  std::array<BeadId, N + 1> beads{};
  std::copy_n(basis.begin(), N, beads.begin());
  beads[N] = bead;
  return beads;
}

/// Returns whether the certificate for equal radii applies to these beads.
template <Motion M>
[[nodiscard]] bool of_equal_radii(Radii radii, const M& motion, std::span<const BeadId> beads, bool is_full) {
  return radii == Radii::equal ||
         (all_equal(beads, degree_of(motion), [&](BeadId b, int k) { return motion.radius(b, k); }) &&
          (!is_full ||
           all_equal(beads, degree_of(motion), [&](BeadId b, int k) { return motion.weight(b, k); })));
}

}  // namespace detail

/// Calls `visit` with the certificate that `bead` lies inside (or, if not `inside`, outside) the sphere of
/// `basis`. The basis has 1 to dimension + 1 beads, ascending. `orientation` is the orientation of a full
/// basis (orientation.h).
template <Motion M, class Visit>
decltype(auto) visit_membership(Radii radii, const M& motion, std::span<const BeadId> basis, BeadId bead,
                                bool inside, int orientation, Visit&& visit) {
  constexpr std::size_t full = M::dimension + 1;
  const bool is_full = basis.size() == full;
  std::array<BeadId, full + 1> all{};
  std::copy(basis.begin(), basis.end(), all.begin());
  all[basis.size()] = bead;
  if (!detail::of_equal_radii(radii, motion, std::span(all).first(basis.size() + 1), is_full)) {
    if (is_full) return visit(BallInSphere<M::dimension, full>{all, inside, orientation});
    if (basis.size() == 1)
      return visit(BallInSphere<M::dimension, 1>{detail::with_bead<1>(basis, bead), inside});
    if constexpr (full == 4) {
      if (basis.size() == 3) return visit(BallInSphere<3, 3>{detail::with_bead<3>(basis, bead), inside});
    }
    return visit(BallInSphere<M::dimension, 2>{detail::with_bead<2>(basis, bead), inside});
  }
  if (is_full) return visit(PowerTest<M::dimension>(all, inside ? -orientation : orientation));
  if (basis.size() == 1) return visit(BeadInSphere<1>{detail::with_bead<1>(basis, bead), inside});
  if constexpr (full == 4) {
    if (basis.size() == 3) return visit(BeadInSphere<3>{detail::with_bead<3>(basis, bead), inside});
  }
  return visit(BeadInSphere<2>{detail::with_bead<2>(basis, bead), inside});
}

}  // namespace kds
