#pragma once
// CGAL's side of a RegularTriangulation, from doubles with exact predicates. For the few files that see CGAL.

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include "motions/grow_little.h"
#include "structures/cgal_triangulations.h"

namespace kds {

using Geometry = CGAL::Exact_predicates_inexact_constructions_kernel;
template <int Dimension>
using CgalOf = CgalTriangulation<Geometry, Dimension>;

template <int Dimension>
[[nodiscard]] typename CgalOf<Dimension>::Type::Weighted_point weighted_point(const Eigen::Matrix3Xd& centers,
                                                                              std::span<const double> weights,
                                                                              std::size_t bead) {
  const auto c = centers.col(static_cast<Eigen::Index>(bead));
  return {CgalOf<Dimension>::point(c.x(), c.y(), c.z()), weights[bead]};
}

template <int Dimension>
void insert_all(typename CgalOf<Dimension>::Type& triangulation, const Eigen::Matrix3Xd& centers,
                std::span<const double> weights) {
  std::vector<std::pair<typename CgalOf<Dimension>::Type::Weighted_point, BeadId>> points;
  points.reserve(weights.size());
  for (std::size_t b = 0; b < weights.size(); ++b)
    points.emplace_back(weighted_point<Dimension>(centers, weights, b), static_cast<BeadId>(b));
  triangulation.insert(points.begin(), points.end());
}

template <int Dimension>
[[nodiscard]] std::vector<CellBeads<Dimension>> sorted_finite_cells(
    const typename CgalOf<Dimension>::Type& triangulation) {
  std::vector<CellBeads<Dimension>> cells;
  if (triangulation.dimension() < Dimension) return cells;
  for (const auto c : CgalOf<Dimension>::finite_cells(triangulation)) cells.push_back(beads_of<Dimension>(c));
  sort_cells(cells);
  return cells;
}

template <int Dimension>
struct RegularTriangulation<Dimension>::Cgal {
  using Types = CgalTriangulation<Geometry, Dimension>;
  using Triangulation = typename Types::Type;
  using CellHandle = typename Types::Cell;
  using VertexHandle = typename Triangulation::Vertex_handle;

  Triangulation triangulation;
  std::vector<VertexHandle> vertex;  // of each bead
  std::vector<CellHandle> cell;      // of each id
  std::vector<CellId> free;

  [[nodiscard]] VertexHandle handle(BeadId bead) const {
    if (bead == infinite_bead) return triangulation.infinite_vertex();
    return bead < vertex.size() ? vertex[bead] : VertexHandle();
  }

  /// Made if there is none yet.
  VertexHandle vertex_of(BeadId bead) {
    if (vertex[bead] == VertexHandle()) {
      vertex[bead] = triangulation.tds().create_vertex();
      vertex[bead]->info() = bead;
    }
    return vertex[bead];
  }

  CellId new_id(CellHandle c) {
    if (free.empty()) {
      c->info() = static_cast<CellId>(cell.size());
      append_little(cell, c);
    } else {
      c->info() = free.back();
      free.pop_back();
      cell[c->info()] = c;
    }
    return c->info();
  }

  // Copies cells into the mirror, and themselves into their neighbours there, whose beads it has already.
  template <class Cells>
  void mirror(const Cells& changed, std::vector<TriangulationCell<Dimension>>& cells) const {
    for (const CellHandle c : changed) cells[c->info()].vertex = beads_of<Dimension>(c);
    for (const CellHandle c : changed) link(c, cells);
  }

 private:
  void link(CellHandle c, std::vector<TriangulationCell<Dimension>>& cells) const {
    TriangulationCell<Dimension>& copy = cells[c->info()];
    for (int i = 0; i <= Dimension; ++i) {
      const auto n = c->neighbor(i);
      const int back = n->index(c);
      const auto here = static_cast<std::size_t>(i), there = static_cast<std::size_t>(back);
      TriangulationCell<Dimension>& neighbor = cells[n->info()];
      copy.beyond[here] = facet_id(n->info(), back);
      copy.apex[here] = neighbor.vertex[there];
      neighbor.beyond[there] = facet_id(c->info(), i);
      neighbor.apex[there] = copy.vertex[here];
    }
  }
};

}  // namespace kds
