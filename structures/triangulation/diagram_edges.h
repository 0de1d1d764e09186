#pragma once
// The edges of a regular triangulation: the pairs of beads whose power cells share a face.

#include <Eigen/Core>
#include <span>
#include <vector>

#include "structures/necklace/bead_pairs.h"
#include "structures/triangulation/regular_triangulation.h"

namespace kds {

struct DiagramEdges {
  BeadPairs edges;             ///< of all beads; hidden ones have none
  std::vector<BeadId> hidden;  ///< ascending
};

/// The edges of a kinetic triangulation, which must have cells; `hidden` are those of its beads 0 ... beads-1
/// that are. Time linear in the cells.
template <int Dimension>
[[nodiscard]] DiagramEdges edges_of(const RegularTriangulation<Dimension>& triangulation, std::size_t beads,
                                    std::vector<BeadId> hidden);

/// The edges of the diagram that CGAL builds from doubles with exact predicates, also where the beads span
/// less than the space. Centres have three rows; in the plane the third is not looked at.
template <int Dimension>
[[nodiscard]] DiagramEdges static_edges(const Eigen::Matrix3Xd& centers, std::span<const double> weights);

}  // namespace kds
