#pragma once
// Static regular triangulations of exact positions: for audits between events, and rebuilds there.

#include <array>
#include <span>

#include "motions/numbers/exact_number.h"
#include "structures/triangulation/regular_triangulation.h"

namespace kds {

/// Position and weight of a bead at one time, exactly.
struct ExactBead {
  std::array<Rational, 3> center;
  Rational weight;
};

/// Built by CGAL with exact numbers. With `oriented`, infinite cells too, as they are; else as from doubles.
template <int Dimension>
[[nodiscard]] StaticTriangulation<Dimension> static_triangulation(std::span<const ExactBead> beads,
                                                                  bool oriented);

}  // namespace kds
