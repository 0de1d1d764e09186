#pragma once
// Which certificates of a triangulation fail where its beads are put: the tests of its facets
// (facet_certificate.h), and that its finite cells are positive. Exact. What is zero is listed too: the
// triangulation may be valid then, but is not the only one.

#include <cstdint>
#include <span>
#include <vector>

#include "motions/curves/snapshot.h"
#include "structures/triangulation/regular_triangulation.h"

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

/// The least sign of a finite cell's orientation: 1, or 0 for a flat, -1 for an inverted one. Cells marked
/// are known to be positive there; those beyond the marks are not.
template <int Dimension>
[[nodiscard]] int least_orientation(const RegularTriangulation<Dimension>& triangulation,
                                    const Snapshot<Dimension>& snapshot,
                                    std::span<const std::uint8_t> known_positive = {});

/// Of all facets and finite cells.
template <int Dimension>
[[nodiscard]] SnapshotFaults snapshot_faults(const RegularTriangulation<Dimension>& triangulation,
                                             const Snapshot<Dimension>& snapshot);

/// Of the live ones among these cells, and of all their facets: one between two of them is met twice.
template <int Dimension>
[[nodiscard]] SnapshotFaults snapshot_faults(const RegularTriangulation<Dimension>& triangulation,
                                             std::span<const CellId> cells,
                                             const Snapshot<Dimension>& snapshot);

}  // namespace kds
