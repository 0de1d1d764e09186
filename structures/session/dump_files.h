#pragma once
// The files written by --dump. Doubles are printed with enough digits to read back the same double.

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "structures/enclosing_sphere/basis.h"
#include "structures/necklace/necklace_tree.h"
#include "structures/necklace/node_sphere.h"
#include "structures/session/structure_spec.h"
#include "structures/triangulation/regular_triangulation.h"

namespace kds {

struct WrappedNode {
  BeadRange range;
  Basis basis;
  Sphere sphere;
};

[[nodiscard]] DumpFile dump_wrapped(std::span<const WrappedNode> nodes);  ///< first,last,basis,x,y,z,radius
[[nodiscard]] DumpFile dump_layered(std::span<const NodeSphere> nodes);   ///< first,last,x,y,z,radius
[[nodiscard]] DumpFile dump_cells(std::span<const CellBeads<2>> cells);   ///< a,b,c
[[nodiscard]] DumpFile dump_cells(std::span<const CellBeads<3>> cells);   ///< a,b,c,d
[[nodiscard]] DumpFile dump_hidden(std::span<const BeadId> hidden);       ///< bead
[[nodiscard]] DumpFile dump_sorted(std::span<const BeadId> order);        ///< bead
[[nodiscard]] DumpFile dump_box(std::span<const BeadId> ends);            ///< axis,min,max
[[nodiscard]] DumpFile dump_hull(std::span<const BeadId> corners);        ///< bead
[[nodiscard]] DumpFile dump_closest(const std::optional<std::array<BeadId, 2>>& pair);  ///< i,j

}  // namespace kds
