#pragma once
// Computes the minimum enclosing sphere of consecutive balls with its basis, in the plane and in space, for
// equal or unequal radii. The algorithm is the LP-type pivoting of Fischer & Gaertner, from scratch or from a
// guess (Welzl's move-to-front is wrong for balls). The basis is exact: its sphere holds all balls and no
// basis ball is superfluous. Centre and radius are rounded; the relative error of the radius is at most
// 1e-12.

#include <array>
#include <span>

#include "structures/enclosing_sphere/basis.h"
#include "structures/enclosing_sphere/exact_sphere.h"
#include "structures/necklace/balls.h"

namespace kds {

struct SmallestSphere {
  Basis basis;
  Sphere sphere;
  bool took_exact = false;  ///< doubles did not suffice
};

/// Returns the smallest sphere of beads first..last. `guess` names beads of the range that may be in the
/// basis, such as an earlier basis and beads that escaped from its sphere. Any guess is valid.
/// ExactUse::everywhere selects the slow reference that uses no doubles.
template <int Dimension>
[[nodiscard]] SmallestSphere smallest_sphere(const Balls<Dimension>& balls, BeadId first, BeadId last,
                                             std::span<const BeadId> guess = {},
                                             ExactUse use = ExactUse::where_needed);

/// Returns whether doubles prove that a basis is proper: each of its balls lies strictly outside the sphere
/// of the others.
template <int Dimension>
[[nodiscard]] bool is_certainly_proper(std::span<const std::array<double, Dimension>> centers,
                                       std::span<const double> radii);

}  // namespace kds
