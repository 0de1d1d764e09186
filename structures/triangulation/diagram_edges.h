#pragma once
// The edges of a regular triangulation: pairs of beads whose power cells share a face.

#include <Eigen/Core>
#include <span>
#include <vector>

#include "structures/necklace/bead_pairs.h"
#include "structures/triangulation/regular_triangulation.h"

namespace kds {

struct DiagramEdges {
  BeadPairs edges;             ///< edges between all beads; a hidden bead has none
  std::vector<BeadId> hidden;  ///< ascending
};

/// Returns the edges of a kinetic triangulation of the beads 0 ... beads-1, which must have cells; `hidden`
/// lists its hidden beads. Takes time linear in the number of cells.
template <int Dimension>
[[nodiscard]] DiagramEdges edges_of(const RegularTriangulation<Dimension>& triangulation, std::size_t beads,
                                    std::vector<BeadId> hidden);

/// Returns the edges of the diagram that CGAL builds from doubles with exact predicates. The beads may span
/// less than the space. Centres have three rows; the third is ignored in the plane.
template <int Dimension>
[[nodiscard]] DiagramEdges static_edges(const Eigen::Matrix3Xd& centers, std::span<const double> weights);

}  // namespace kds
