#pragma once
// The minimum enclosing sphere of consecutive balls with its basis, in the plane and in space, radii equal or
// not: the LP-type pivoting of Fischer & Gaertner (Welzl's move-to-front is wrong for balls), from scratch or
// from a guess. The basis is exact: its sphere holds all balls and none of its own is to spare. Centre and
// radius are rounded, the radius to 1e-12 of its size and better.

#include <array>
#include <span>

#include "structures/enclosing_sphere/basis.h"
#include "structures/enclosing_sphere/exact_enclosing_sphere.h"
#include "structures/necklace/balls.h"
#include "structures/necklace/sphere.h"

namespace kds {

struct SmallestSphere {
  Basis basis;
  Sphere sphere;
  bool took_exact = false;  ///< doubles did not suffice
};

/// Beads first..last. `guess`: beads among them that may be in the basis, as an earlier basis and beads that
/// escaped from its sphere; any will do. ExactUse::everywhere: the slow twin that asks no double.
template <int Dimension>
[[nodiscard]] SmallestSphere smallest_sphere(const Balls<Dimension>& balls, BeadId first, BeadId last,
                                             std::span<const BeadId> guess = {},
                                             ExactUse use = ExactUse::where_needed);

/// Whether doubles prove that a basis is one: each of its balls strictly outside the sphere of the others.
template <int Dimension>
[[nodiscard]] bool is_certainly_proper(std::span<const std::array<double, Dimension>> centers,
                                       std::span<const double> radii);

}  // namespace kds
