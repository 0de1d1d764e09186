#pragma once
// A dual complex in space as lists of simplices that name their faces by index.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "motions/base/bead.h"

namespace kds {

/// The simplices of a dual complex. A simplex names its faces by their index in the lists of lower dimension,
/// and the lists contain all faces of each simplex.
struct ComplexSimplices {
  using Edge = std::array<BeadId, 2>;
  struct Triangle {
    std::array<BeadId, 3> beads{};
    std::array<std::uint32_t, 3> edges{};  ///< edges[i] is opposite to beads[i]
  };
  struct Tetrahedron {
    std::array<BeadId, 4> beads{};
    std::array<std::uint32_t, 6> edges{};      ///< between the beads that `tetrahedron_edges` lists
    std::array<std::uint32_t, 4> triangles{};  ///< triangles[i] is opposite to beads[i]
  };

  std::vector<BeadId> vertices;
  std::vector<Edge> edges;  ///< beads ascending
  std::vector<Triangle> triangles;
  std::vector<Tetrahedron> tetrahedra;
};

/// The ends of the six edges of a tetrahedron, as indices of its beads. Edges e and 5 - e are opposite.
inline constexpr std::array<std::array<std::size_t, 2>, 6> tetrahedron_edges{
    {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

}  // namespace kds
