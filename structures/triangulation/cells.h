#pragma once
// Cells of a regular triangulation in the plane or in space, by name, and a static one as a list of them.

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

/// The facet opposite to vertex i of a cell, as that cell has it: 4 cell + i.
using FacetId = std::uint32_t;
[[nodiscard]] constexpr FacetId facet_id(CellId cell, int i) { return 4 * cell + static_cast<FacetId>(i); }
[[nodiscard]] constexpr CellId cell_of(FacetId facet) { return facet / 4; }
[[nodiscard]] constexpr int index_of(FacetId facet) { return static_cast<int>(facet % 4); }

/// In space just a cache line.
template <int Dimension>
struct alignas(Dimension == 3 ? 64 : 4) TriangulationCell {
  CellBeads<Dimension> vertex{};
  std::array<FacetId, static_cast<std::size_t>(Dimension) + 1>
      beyond{};                 ///< its facets as the neighbours have them
  CellBeads<Dimension> apex{};  ///< the bead beyond each facet
  /// What the triangulation's owner notes of its facets. 0 where a cell is new; flips leave it as it is.
  std::array<std::uint32_t, static_cast<std::size_t>(Dimension) + 1> note{};

  /// dimension + 1 where the bead is no vertex.
  [[nodiscard]] int place_of(BeadId bead) const {
    int place = 0;
    while (place <= Dimension && vertex[static_cast<std::size_t>(place)] != bead) ++place;
    return place;
  }
};

/// Cells of a static triangulation, and beads without a cell of their own in the power diagram.
template <int Dimension>
struct StaticTriangulation {
  std::vector<CellBeads<Dimension>> cells;  ///< positively oriented; infinite ones too where asked for
  std::vector<BeadId> hidden;               ///< ascending
  int dimension = Dimension;                ///< of the points' affine hull; no cells below the space's own
};

}  // namespace kds
