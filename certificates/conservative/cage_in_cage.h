#pragma once
// "The sphere of one cage stays inside that of another": R_outer - R_inner >= |C_outer - C_inner|. A
// conservative test on enclosures: early, never late. Cages that touch for good, as those that share a basis
// bead do, cannot be told apart and it gives up at once.

#include <span>

#include "certificates/conservative/cage_sphere.h"
#include "certificates/conservative/proved_until.h"

namespace kds {

/// Whether it is proved all over [lower, upper].
template <Motion M>
[[nodiscard]] bool cage_in_cage_on(const M& motion, std::span<const BeadId> inner,
                                   std::span<const BeadId> outer, double lower, double upper) {
  const PieceView<M> view(motion, lower, upper);
  const auto in = cage_sphere(view, inner);
  if (!in) return false;
  const auto out = cage_sphere(view, outer);
  if (!out) return false;
  const MeanValue room = out->radius - in->radius;
  if (!(room.range.lower >= 0)) return false;
  return (square(room) - square_distance(view, inner[0], *in, outer[0], *out)).range.lower >= 0;
}

/// The largest time such that the test proves it from `from` on, with at most so many pieces.
template <Motion M>
[[nodiscard]] double cage_in_cage_until(const M& motion, std::span<const BeadId> inner,
                                        std::span<const BeadId> outer, double from,
                                        int pieces = default_pieces) {
  return proved_until(from, pieces, [&](double lower, double upper) {
    return cage_in_cage_on(motion, inner, outer, lower, upper);
  });
}

}  // namespace kds
