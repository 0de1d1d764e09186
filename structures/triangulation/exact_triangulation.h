#pragma once
// Static regular triangulations of exact positions, for audits between events and for rebuilds.

#include <array>
#include <span>

#include "motions/numbers/exact_number.h"
#include "structures/triangulation/regular_triangulation.h"

namespace kds {

/// Exact position and weight of a bead at one time.
struct ExactBead {
  std::array<Rational, 3> center;
  Rational weight;
};

/// Returns the triangulation built by CGAL with exact numbers. If `oriented`, infinite cells are included and
/// cells keep their orientation; otherwise the result has the same form as the one built from doubles.
template <int Dimension>
[[nodiscard]] StaticTriangulation<Dimension> static_triangulation(std::span<const ExactBead> beads,
                                                                  bool oriented);

}  // namespace kds
