#pragma once
// Finds the certificates of a triangulation that fail at given positions: the certificates of its facets
// (facet_certificate.h) and the orientations of its finite cells. Exact. Certificates that are zero are
// listed too: in this case the triangulation may be valid, but other triangulations are valid as well.

#include <cstdint>
#include <span>
#include <vector>

#include "motions/curves/snapshot.h"
#include "structures/triangulation/regular_triangulation.h"

namespace kds {

struct SnapshotFaults {
  std::uint64_t tested = 0;
  std::vector<FacetId> facets, zero_facets;
  std::vector<CellId> cells, flat_cells;  ///< inverted cells; flat cells

  [[nodiscard]] std::uint64_t failed() const { return facets.size() + cells.size(); }
  [[nodiscard]] bool none_strictly() const {
    return failed() == 0 && zero_facets.empty() && flat_cells.empty();
  }
};

/// Returns -1 if some finite cell is inverted, otherwise 0 if some finite cell is flat, otherwise 1. Marked
/// cells are known to be positive; cells beyond the end of the marks count as not marked.
template <int Dimension>
[[nodiscard]] int least_orientation(const RegularTriangulation<Dimension>& triangulation,
                                    const Snapshot<Dimension>& snapshot,
                                    std::span<const std::uint8_t> known_positive = {});

/// Tests all facets and finite cells.
template <int Dimension>
[[nodiscard]] SnapshotFaults snapshot_faults(const RegularTriangulation<Dimension>& triangulation,
                                             const Snapshot<Dimension>& snapshot);

/// Tests the live ones among these cells, and all their facets. A facet between two of these cells is listed
/// twice.
template <int Dimension>
[[nodiscard]] SnapshotFaults snapshot_faults(const RegularTriangulation<Dimension>& triangulation,
                                             std::span<const CellId> cells,
                                             const Snapshot<Dimension>& snapshot);

}  // namespace kds
