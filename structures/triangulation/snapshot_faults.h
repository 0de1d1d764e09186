#pragma once
// Which certificates of a triangulation fail where its beads are put: the tests of its facets
// (facet_certificate.h), and that its finite cells are positive. Exact. What is zero is listed too: the
// triangulation may be valid then, but is not the only one.

#include <algorithm>
#include <array>
#include <concepts>
#include <cstdint>
#include <ranges>
#include <span>
#include <vector>

#include "certificates/search/snapshot_sign.h"
#include "structures/triangulation/facet_certificate.h"

namespace kds {

struct SnapshotFaults {
  std::uint64_t tested = 0;
  std::vector<FacetId> facets, zero_facets;
  std::vector<CellId> cells, flat_cells;  ///< inverted; and flat

  [[nodiscard]] std::uint64_t failed() const { return facets.size() + cells.size(); }
  [[nodiscard]] bool none_strictly() const {
    return failed() == 0 && zero_facets.empty() && flat_cells.empty();
  }
};

namespace detail {

/// Tests of one kind, four at a time.
template <class Certificate, int Dimension>
class FourAtSnapshot {
 public:
  using Beads = std::array<BeadId, Certificate::size>;

  explicit FourAtSnapshot(const Snapshot<Dimension>& placement) : placement_(placement) {}

  /// `failed(place, sign)` is called, now or later, where the certificate of these beads is not positive.
  template <class Failed>
  void test(const Beads& beads, std::uint32_t place, Failed failed) {
    tuples_[count_] = beads;
    places_[count_] = place;
    if (++count_ == Lanes::width) flush(failed);
  }
  template <class Failed>
  void flush(Failed failed) {
    if (count_ == 0) return;
    for (std::size_t lane = count_; lane < Lanes::width; ++lane) tuples_[lane] = tuples_[0];
    Lanes::Mask positive;
    snapshot_positive<Certificate>(placement_, tuples_, Lanes(1.0), positive);
    if (!Lanes::all(positive)) {
      for (std::size_t lane = 0; lane < count_; ++lane) {
        if (positive[lane] != 0) continue;
        const int sign = snapshot_sign(Certificate(tuples_[lane], 1), placement_);
        if (sign <= 0) failed(places_[lane], sign);
      }
    }
    count_ = 0;
  }

 private:
  const Snapshot<Dimension>& placement_;
  std::array<Beads, Lanes::width> tuples_{};
  std::array<std::uint32_t, Lanes::width> places_{};
  std::size_t count_ = 0;
};

template <int Dimension, class Cells>
[[nodiscard]] SnapshotFaults faults_of(const RegularTriangulation<Dimension>& triangulation,
                                       const Cells& cells, const Snapshot<Dimension>& placement) {
  // Of all cells a facet is met twice, and tested once.
  constexpr bool of_all = !std::same_as<Cells, std::span<const CellId>>;
  SnapshotFaults faults;
  const auto facet_fails = [&](FacetId facet, int sign) {
    (sign < 0 ? faults.facets : faults.zero_facets).push_back(facet);
  };
  const auto cell_fails = [&](CellId cell, int sign) {
    (sign < 0 ? faults.cells : faults.flat_cells).push_back(cell);
  };
  detail::FourAtSnapshot<PowerTest<Dimension>, Dimension> power_tests(placement);
  detail::FourAtSnapshot<Orientation<Dimension>, Dimension> orientations(placement);
  const auto all = triangulation.cells();
  for (const CellId cell : cells) {
    if (!triangulation.is_live(cell)) continue;
    const CellBeads<Dimension>& v = all[cell].vertex;
    const bool finite = std::find(v.begin(), v.end(), infinite_bead) == v.end();
    if (finite) {
      ++faults.tested;
      orientations.test(v, cell, cell_fails);
    }
    for (int i = 0; i <= Dimension; ++i) {
      const FacetId beyond = triangulation.beyond(cell, i);
      const BeadId apex = triangulation.apex_beyond(cell, i);
      if (apex == infinite_bead || v[static_cast<std::size_t>(i)] == infinite_bead) {
        if (finite || apex != infinite_bead) continue;  // the finite cell's own orientation
      }
      if (of_all && cell_of(beyond) < cell) continue;
      ++faults.tested;
      if (finite) {
        std::array<BeadId, Dimension + 2> beads{};
        std::copy(v.begin(), v.end(), beads.begin());
        beads.back() = apex;
        power_tests.test(beads, facet_id(cell, i), facet_fails);
      } else {
        with_facet_certificate(v, apex, [&](const auto& certificate) {
          const int sign = snapshot_sign(certificate, placement);
          if (sign <= 0) facet_fails(facet_id(cell, i), sign);
        });
      }
    }
  }
  power_tests.flush(facet_fails);
  orientations.flush(cell_fails);
  return faults;
}

}  // namespace detail

/// The least sign of a finite cell's orientation: 1, or 0 for a flat, -1 for an inverted one. Cells marked
/// are known to be positive there; those beyond the marks are not.
template <int Dimension>
[[nodiscard]] int least_orientation(const RegularTriangulation<Dimension>& triangulation,
                                    const Snapshot<Dimension>& placement,
                                    std::span<const std::uint8_t> known_positive = {}) {
  int least = 1;
  const auto fails = [&](CellId, int sign) { least = std::min(least, sign); };
  detail::FourAtSnapshot<Orientation<Dimension>, Dimension> orientations(placement);
  const auto all = triangulation.cells();
  for (CellId cell = 0; cell < all.size(); ++cell) {
    if (cell < known_positive.size() && known_positive[cell] != 0) continue;
    const CellBeads<Dimension>& v = all[cell].vertex;
    if (triangulation.is_live(cell) && std::find(v.begin(), v.end(), infinite_bead) == v.end())
      orientations.test(v, cell, fails);
  }
  orientations.flush(fails);
  return least;
}

/// Of all facets and finite cells.
template <int Dimension>
[[nodiscard]] SnapshotFaults snapshot_faults(const RegularTriangulation<Dimension>& triangulation,
                                             const Snapshot<Dimension>& placement) {
  const auto count = static_cast<CellId>(triangulation.cells().size());
  return detail::faults_of(triangulation, std::views::iota(CellId{0}, count), placement);
}

/// Of the live ones among these cells, and of all their facets: one between two of them is met twice.
template <int Dimension>
[[nodiscard]] SnapshotFaults snapshot_faults(const RegularTriangulation<Dimension>& triangulation,
                                             std::span<const CellId> cells,
                                             const Snapshot<Dimension>& placement) {
  return detail::faults_of(triangulation, cells, placement);
}

}  // namespace kds
