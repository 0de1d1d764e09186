#pragma once
// What guards a facet of a regular triangulation: the power test of its two cells' beads, or, where the
// infinite vertex is among them, the orientation of the others (the hull is locally convex there).

#include <algorithm>
#include <utility>

#include "certificates/orientation.h"
#include "certificates/power_test.h"
#include "structures/regular_triangulation.h"

namespace kds {

/// Calls `use` with the certificate of the facet between a cell and the one with this apex beyond it.
template <std::size_t N, class Use>
[[gnu::always_inline]] inline decltype(auto) with_facet_certificate(const std::array<BeadId, N>& cell,
                                                                    BeadId apex, Use use) {
  constexpr int dimension = static_cast<int>(N) - 1;
  const auto beads = [&]<std::size_t... I>(std::index_sequence<I...>) { return std::array{cell[I]..., apex}; }
  (std::make_index_sequence<N>{});
  const PowerTest<dimension> test(beads, 1);
  if (test.beads.back() != infinite_bead) return use(test);
  // Sorted, infinity is last: a row (0, ..., 0, 1) there leaves the determinant of the others.
  Orientation<dimension> orientation;
  std::copy(test.beads.begin(), test.beads.end() - 1, orientation.beads.begin());
  orientation.sign = test.sign;
  return use(orientation);
}

}  // namespace kds
