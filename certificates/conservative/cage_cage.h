#pragma once
// "The closed spheres of two cages stay disjoint": |C_a - C_b| > R_a + R_b. A conservative test on
// enclosures: early, never late.

#include <span>

#include "certificates/conservative/cage_sphere.h"
#include "certificates/conservative/proved_until.h"

namespace kds {

/// Whether it is proved all over [lower, upper].
template <Motion M>
[[nodiscard]] bool cages_disjoint_on(const M& motion, std::span<const BeadId> a, std::span<const BeadId> b,
                                     double lower, double upper) {
  const PieceView<M> view(motion, lower, upper);
  const auto first = cage_sphere(view, a);
  if (!first) return false;
  const auto second = cage_sphere(view, b);
  if (!second) return false;
  const MeanValue reach = first->radius + second->radius;
  return (square_distance(view, a[0], *first, b[0], *second) - square(reach)).range.lower > 0;
}

/// The largest time such that the test proves it from `from` on, with at most so many pieces. It is proved
/// for that time too, unless that is `from`.
template <Motion M>
[[nodiscard]] double cages_disjoint_until(const M& motion, std::span<const BeadId> a,
                                          std::span<const BeadId> b, double from,
                                          int pieces = default_pieces) {
  return proved_until(from, pieces, [&](double lower, double upper) {
    return cages_disjoint_on(motion, a, b, lower, upper);
  });
}

}  // namespace kds
