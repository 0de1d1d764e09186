#pragma once
// The cells of a regular triangulation in the plane or in space: their names and data, and static
// triangulations as lists of cells.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "motions/base/bead.h"

namespace kds {

inline constexpr BeadId infinite_bead = no_bead;
using CellId = std::uint32_t;
inline constexpr CellId no_cell = std::numeric_limits<CellId>::max();
template <int Dimension>
using CellBeads = std::array<BeadId, static_cast<std::size_t>(Dimension) + 1>;

/// The facet opposite to vertex i of a cell, named as a facet of this cell: 4 cell + i.
using FacetId = std::uint32_t;
[[nodiscard]] constexpr FacetId facet_id(CellId cell, int i) { return 4 * cell + static_cast<FacetId>(i); }
[[nodiscard]] constexpr CellId cell_of(FacetId facet) { return facet / 4; }
[[nodiscard]] constexpr int index_of(FacetId facet) { return static_cast<int>(facet % 4); }

/// One cell of a triangulation. In space it fills exactly one cache line.
template <int Dimension>
struct alignas(Dimension == 3 ? 64 : 4) TriangulationCell {
  CellBeads<Dimension> vertex{};
  std::array<FacetId, static_cast<std::size_t>(Dimension) + 1>
      beyond{};                 ///< its facets, named as facets of the neighbours
  CellBeads<Dimension> apex{};  ///< the bead beyond each facet
  /// Data that the triangulation's owner stores for each facet. 0 in a new cell; flips leave it unchanged.
  std::array<std::uint32_t, static_cast<std::size_t>(Dimension) + 1> note{};

  /// Returns the index of the bead among the vertices, or Dimension + 1 if the bead is not a vertex.
  [[nodiscard]] int vertex_index(BeadId bead) const {
    int index = 0;
    while (index <= Dimension && vertex[static_cast<std::size_t>(index)] != bead) ++index;
    return index;
  }
};

/// Cells of a static triangulation, and the beads that have no cell of their own in the power diagram.
template <int Dimension>
struct StaticTriangulation {
  std::vector<CellBeads<Dimension>> cells;  ///< positively oriented; infinite ones only if requested
  std::vector<BeadId> hidden;               ///< ascending
  int dimension = Dimension;                ///< the affine hull's dimension; no cells if below Dimension
};

/// A canonical form of lists of cells: each cell's beads ascending, cells in lexicographic order.
template <class CellOfBeads>
void sort_cells(std::vector<CellOfBeads>& cells) {
  for (auto& cell : cells) std::sort(cell.begin(), cell.end());
  std::sort(cells.begin(), cells.end());
}

}  // namespace kds
