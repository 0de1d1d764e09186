#pragma once
// What guards a facet of a regular triangulation: the power test of its two cells' beads, or, where the
// infinite vertex is among them, the orientation of the others (the hull is locally convex there).

#include <algorithm>

#include "certificates/orientation.h"
#include "certificates/power_test.h"
#include "structures/regular_triangulation.h"

namespace kds {

/// The certificates of a cell's facets: its beads are sorted once for all of them.
template <std::size_t N>
class FacetCertificates {
 public:
  static constexpr int dimension = static_cast<int>(N) - 1;

  [[gnu::always_inline]] explicit FacetCertificates(const std::array<BeadId, N>& cell)
      : sorted_(cell), sign_(sort_beads(sorted_)) {}

  /// Calls `use` with the certificate of the facet to the cell with this apex beyond it.
  template <class Use>
  [[gnu::always_inline]] decltype(auto) to(BeadId apex, Use use) const {
    PowerTest<dimension> test;
    std::copy(sorted_.begin(), sorted_.end(), test.beads.begin());
    test.beads.back() = apex;
    test.sign = sign_ * sort_last_bead(test.beads);
    if (test.beads.back() != infinite_bead) return use(test);
    // Sorted, infinity is last: a row (0, ..., 0, 1) there leaves the determinant of the others.
    Orientation<dimension> orientation;
    std::copy(test.beads.begin(), test.beads.end() - 1, orientation.beads.begin());
    orientation.sign = test.sign;
    return use(orientation);
  }

 private:
  std::array<BeadId, N> sorted_;
  int sign_;
};

/// The same for one facet.
template <std::size_t N, class Use>
[[gnu::always_inline]] inline decltype(auto) with_facet_certificate(const std::array<BeadId, N>& cell,
                                                                    BeadId apex, Use use) {
  return FacetCertificates(cell).to(apex, use);
}

}  // namespace kds
