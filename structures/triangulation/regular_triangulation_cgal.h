#pragma once
// The CGAL part of a RegularTriangulation, built from doubles with exact predicates. Include it only in the
// few files that use CGAL.

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/spatial_sort.h>

#include <boost/property_map/function_property_map.hpp>
#include <numeric>

#include "motions/base/grow_little.h"
#include "motions/base/interruption.h"
#include "structures/triangulation/cgal_triangulations.h"

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

/// Inserts all beads in the order in which CGAL inserts a range, but asks in between whether to go on.
template <int Dimension>
void insert_all(typename CgalOf<Dimension>::Type& triangulation, const Eigen::Matrix3Xd& centers,
                std::span<const double> weights) {
  const auto point = [&](BeadId bead) {
    const auto c = centers.col(static_cast<Eigen::Index>(bead));
    return CgalOf<Dimension>::point(c.x(), c.y(), c.z());
  };
  std::vector<BeadId> beads(weights.size());
  std::iota(beads.begin(), beads.end(), BeadId{0});
  const auto point_of = boost::make_function_property_map<BeadId>(point);
  CGAL::spatial_sort(beads.begin(), beads.end(),
                     typename CgalOf<Dimension>::template SortTraits<decltype(point_of)>(point_of));
  auto near = typename CgalOf<Dimension>::Cell();
  for (const BeadId bead : beads) {
    InterruptionCheck::ask();
    const auto vertex =
        CgalOf<Dimension>::insert(triangulation, weighted_point<Dimension>(centers, weights, bead), near);
    if (vertex != typename CgalOf<Dimension>::Type::Vertex_handle()) vertex->info() = bead;
  }
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
  std::vector<VertexHandle> vertex;  // for each bead
  std::vector<CellHandle> cell;      // for each id; empty if there is no such cell
  // Changes of the mirror that are not yet copied.
  std::vector<BeadId> turned;  // beads that became vertices or stopped being vertices
  std::vector<CellId> changed;
  std::vector<char> is_turned, is_changed;  // for each bead, for each id

  [[nodiscard]] VertexHandle handle(BeadId bead) const {
    if (bead == infinite_bead) return triangulation.infinite_vertex();
    return bead < vertex.size() ? vertex[bead] : VertexHandle();
  }

  /// Returns the vertex of a bead, and creates it if needed.
  VertexHandle vertex_of(BeadId bead) {
    if (vertex[bead] == VertexHandle()) {
      vertex[bead] = triangulation.tds().create_vertex();
      vertex[bead]->info() = bead;
    }
    return vertex[bead];
  }

  void name(CellHandle c, CellId id) {
    grow_little(cell, id + 1);
    cell[id] = c;
    c->info() = id;
  }

  /// Notes that a cell was created or removed.
  void change(CellId id) {
    grow_little(is_changed, id + 1);
    if (is_changed[id] != 0) return;
    is_changed[id] = 1;
    append_little(changed, id);
  }
  /// Notes that a bead became a vertex or stopped being one.
  void turn(BeadId bead) {
    grow_little(is_turned, bead + std::size_t{1});
    if (is_turned[bead] != 0) return;
    is_turned[bead] = 1;
    append_little(turned, bead);
  }
  [[nodiscard]] bool is_behind() const { return !changed.empty(); }
  void forget_changes() {
    turned.clear();
    changed.clear();
    std::fill(is_turned.begin(), is_turned.end(), char{0});
    std::fill(is_changed.begin(), is_changed.end(), char{0});
  }

  /// Copies all changes of the mirror into CGAL's structure.
  void follow(std::span<const TriangulationCell<Dimension>> cells, std::span<const char> live,
              std::span<const std::uint32_t> cells_at) {
    auto& tds = triangulation.tds();
    for (const BeadId bead : turned) {
      is_turned[bead] = 0;
      if (cells_at[bead] > 0) {
        vertex_of(bead);
      } else if (vertex[bead] != VertexHandle()) {
        tds.delete_vertex(vertex[bead]);
        vertex[bead] = {};
      }
    }
    grow_little(cell, cells.size());
    for (const CellId id : changed) {
      is_changed[id] = 0;
      if (live[id] != 0 || cell[id] == CellHandle()) continue;
      Types::delete_cell(tds, cell[id]);
      cell[id] = {};
    }
    for (const CellId id : changed) {
      if (live[id] != 0 && cell[id] == CellHandle()) name(Types::create_cell(tds), id);
    }
    for (std::size_t k = 0; k < changed.size(); ++k) {
      if (k + 4 < changed.size()) fetch(changed[k + 4], cells);
      if (live[changed[k]] != 0) rewrite(changed[k], cells[changed[k]]);
    }
    turned.clear();
    changed.clear();
  }

  /// Sets the points of all vertices.
  void put(const Snapshot<Dimension>& placement) {
    for (BeadId b = 0; b < vertex.size(); ++b) {
      if (vertex[b] == VertexHandle()) continue;
      const double* c = placement.control_point(b, 0);
      vertex[b]->set_point({Types::point(c[0], c[1], c[2]), placement.weight(b, 0)});
    }
  }

  /// Copies these cells into the mirror and links them with their neighbours. The mirror must already have
  /// the beads of all other cells.
  template <class Cells>
  void mirror(const Cells& some, std::vector<TriangulationCell<Dimension>>& cells) const {
    for (const CellHandle c : some) cells[c->info()].vertex = beads_of<Dimension>(c);
    for (const CellHandle c : some) link(c, cells);
  }

 private:
  // Prefetches a cell, because cells are scattered in memory.
  void fetch(CellId id, std::span<const TriangulationCell<Dimension>> cells) const {
    __builtin_prefetch(&cells[id]);
    if (cell[id] == CellHandle()) return;
    __builtin_prefetch(&*cell[id], 1);
    __builtin_prefetch(reinterpret_cast<const char*>(&*cell[id]) + 64, 1);
  }

  void rewrite(CellId id, const TriangulationCell<Dimension>& copy) {
    const CellHandle c = cell[id];
    for (int i = 0; i <= Dimension; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const VertexHandle v = handle(copy.vertex[at]);
      c->set_vertex(i, v);
      Types::set_cell(v, c);
      const CellHandle n = cell[cell_of(copy.beyond[at])];
      c->set_neighbor(i, n);
      n->set_neighbor(index_of(copy.beyond[at]), c);
    }
  }

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
