#include "structures/regular_triangulation.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Regular_triangulation_3.h>
#include <CGAL/Regular_triangulation_cell_base_3.h>
#include <CGAL/Regular_triangulation_vertex_base_3.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <stdexcept>

#include "structures/sorted_cells.h"

namespace kds {

namespace {

using Geometry = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase =
    CGAL::Triangulation_vertex_base_with_info_3<BeadId, Geometry,
                                                CGAL::Regular_triangulation_vertex_base_3<Geometry>>;
using CellBase = CGAL::Triangulation_cell_base_with_info_3<CellId, Geometry,
                                                           CGAL::Regular_triangulation_cell_base_3<Geometry>>;
using Triangulation =
    CGAL::Regular_triangulation_3<Geometry, CGAL::Triangulation_data_structure_3<VertexBase, CellBase>>;
using WeightedPoint = Triangulation::Weighted_point;

WeightedPoint weighted_point(const Eigen::Matrix3Xd& centers, std::span<const double> weights,
                             std::size_t bead) {
  const auto c = centers.col(static_cast<Eigen::Index>(bead));
  return {Triangulation::Bare_point(c.x(), c.y(), c.z()), weights[bead]};
}

void insert_all(Triangulation& triangulation, const Eigen::Matrix3Xd& centers,
                std::span<const double> weights) {
  std::vector<std::pair<WeightedPoint, BeadId>> points;
  points.reserve(weights.size());
  for (std::size_t b = 0; b < weights.size(); ++b)
    points.emplace_back(weighted_point(centers, weights, b), static_cast<BeadId>(b));
  triangulation.insert(points.begin(), points.end());
}

std::vector<BeadId> hidden_beads(const Triangulation& triangulation, std::size_t beads) {
  std::vector<char> visible(beads, 0);
  for (const auto v : triangulation.finite_vertex_handles()) visible[v->info()] = 1;
  std::vector<BeadId> hidden;
  for (std::size_t b = 0; b < beads; ++b) {
    if (visible[b] == 0) hidden.push_back(static_cast<BeadId>(b));
  }
  return hidden;
}

std::vector<CellBeads> sorted_finite_cells(const Triangulation& triangulation) {
  std::vector<CellBeads> cells;
  if (triangulation.dimension() < 3) return cells;
  for (const auto c : triangulation.finite_cell_handles()) {
    cells.push_back({c->vertex(0)->info(), c->vertex(1)->info(), c->vertex(2)->info(), c->vertex(3)->info()});
  }
  sort_cells(cells);
  return cells;
}

}  // namespace

StaticTriangulation static_triangulation(const Eigen::Matrix3Xd& centers, std::span<const double> weights) {
  Triangulation triangulation;
  insert_all(triangulation, centers, weights);
  return {sorted_finite_cells(triangulation), hidden_beads(triangulation, weights.size()),
          triangulation.dimension()};
}

double seconds_to_triangulate(const Eigen::Matrix3Xd& centers, std::span<const double> weights) {
  std::vector<WeightedPoint> points;
  points.reserve(weights.size());
  for (std::size_t b = 0; b < weights.size(); ++b) points.push_back(weighted_point(centers, weights, b));
  const auto start = std::chrono::steady_clock::now();
  const Triangulation triangulation(points.begin(), points.end());
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

struct RegularTriangulation::Cgal {
  Triangulation triangulation;
  std::vector<Triangulation::Vertex_handle> vertex;  // of each bead
  std::vector<Triangulation::Cell_handle> cell;      // of each id
  std::vector<CellId> free;

  [[nodiscard]] Triangulation::Vertex_handle handle(BeadId bead) const {
    if (bead == infinite_bead) return triangulation.infinite_vertex();
    return bead < vertex.size() ? vertex[bead] : Triangulation::Vertex_handle();
  }

  CellId new_id(Triangulation::Cell_handle c) {
    if (free.empty()) {
      c->info() = static_cast<CellId>(cell.size());
      cell.push_back(c);
    } else {
      c->info() = free.back();
      free.pop_back();
      cell[c->info()] = c;
    }
    return c->info();
  }

  // Copies a cell into the mirror, and itself into its neighbours there.
  void mirror(Triangulation::Cell_handle c, std::vector<TriangulationCell>& cells) const {
    TriangulationCell& copy = cells[c->info()];
    for (int i = 0; i < 4; ++i) {
      copy.vertex[static_cast<std::size_t>(i)] = c->vertex(i)->info();
      const auto n = c->neighbor(i);
      const int back = n->index(c);
      copy.beyond[static_cast<std::size_t>(i)] = facet_id(n->info(), back);
      cells[n->info()].beyond[static_cast<std::size_t>(back)] = facet_id(c->info(), i);
    }
  }
};

RegularTriangulation::RegularTriangulation() : cgal_(std::make_unique<Cgal>()) {}
RegularTriangulation::~RegularTriangulation() = default;

StaticTriangulation RegularTriangulation::build(const Eigen::Matrix3Xd& centers,
                                                std::span<const double> weights) {
  auto& triangulation = cgal_->triangulation;
  triangulation.clear();
  insert_all(triangulation, centers, weights);
  triangulation.infinite_vertex()->info() = infinite_bead;
  cgal_->vertex.assign(weights.size(), {});
  for (const auto v : triangulation.finite_vertex_handles()) cgal_->vertex[v->info()] = v;
  StaticTriangulation result{{}, hidden_beads(triangulation, weights.size()), triangulation.dimension()};
  if (result.dimension == 3) {
    mirror_all();
  } else {
    cells_.clear();
    live_.clear();
  }
  return result;
}

void RegularTriangulation::assign(std::size_t beads, std::span<const CellBeads> oriented_cells) {
  auto& triangulation = cgal_->triangulation;
  std::vector<WeightedPoint> points(beads);
  for (std::size_t b = 0; b < beads && b < cgal_->vertex.size(); ++b) {
    if (cgal_->vertex[b] != Triangulation::Vertex_handle()) points[b] = cgal_->vertex[b]->point();
  }
  triangulation.clear();
  auto& tds = triangulation.tds();
  tds.clear();
  tds.set_dimension(3);
  const auto infinite = tds.create_vertex();
  infinite->info() = infinite_bead;
  triangulation.set_infinite_vertex(infinite);
  cgal_->vertex.assign(beads, {});
  for (std::size_t b = 0; b < beads; ++b) {
    cgal_->vertex[b] = tds.create_vertex();
    cgal_->vertex[b]->info() = static_cast<BeadId>(b);
    cgal_->vertex[b]->set_point(points[b]);
  }
  // Facets of two cells meet here by their beads.
  std::map<std::array<BeadId, 3>, std::pair<Triangulation::Cell_handle, int>> open;
  for (const CellBeads& beads_of_cell : oriented_cells) {
    const auto c = tds.create_cell();
    for (int i = 0; i < 4; ++i) {
      const BeadId b = beads_of_cell[static_cast<std::size_t>(i)];
      const auto v = b == infinite_bead ? infinite : cgal_->vertex[b];
      c->set_vertex(i, v);
      v->set_cell(c);
    }
    for (int i = 0; i < 4; ++i) {
      std::array<BeadId, 3> facet{};
      for (int j = 0, k = 0; j < 4; ++j) {
        if (j != i) facet[static_cast<std::size_t>(k++)] = beads_of_cell[static_cast<std::size_t>(j)];
      }
      std::sort(facet.begin(), facet.end());
      if (const auto other = open.find(facet); other == open.end()) {
        open.emplace(facet, std::pair(c, i));
      } else {
        c->set_neighbor(i, other->second.first);
        other->second.first->set_neighbor(other->second.second, c);
        open.erase(other);
      }
    }
  }
  if (!open.empty()) throw std::logic_error("the cells to assign do not close up");
  mirror_all();
}

void RegularTriangulation::mirror_all() {
  cgal_->cell.clear();
  cgal_->free.clear();
  for (const auto c : cgal_->triangulation.all_cell_handles()) cgal_->new_id(c);
  cells_.assign(cgal_->cell.size(), {});
  live_.assign(cgal_->cell.size(), 1);
  for (const auto c : cgal_->cell) cgal_->mirror(c, cells_);
}

void RegularTriangulation::set_points(const Eigen::Matrix3Xd& centers, std::span<const double> weights) {
  for (std::size_t b = 0; b < cgal_->vertex.size(); ++b) {
    if (cgal_->vertex[b] != Triangulation::Vertex_handle())
      cgal_->vertex[b]->set_point(weighted_point(centers, weights, b));
  }
}

std::array<CellId, 3> RegularTriangulation::flip_facet(CellId cell, int i) {
  const auto c = cgal_->cell[cell];
  const auto n = c->neighbor(i);
  const int i2 = (i + 2) & 3;
  cgal_->triangulation.tds().flip_flippable(c, i);
  // The new cell is across the facet that CGAL leaves opposite to the place of the second vertex after i.
  const auto made = c->neighbor(i2);
  const CellId id = cgal_->new_id(made);
  if (id == cells_.size()) {
    cells_.emplace_back();
    live_.push_back(0);
  }
  live_[id] = 1;
  for (const auto changed : {c, n, made}) cgal_->mirror(changed, cells_);
  return {cell, n->info(), id};
}

std::array<CellId, 2> RegularTriangulation::flip_edge(CellId cell, int i, int j) {
  const auto c = cgal_->cell[cell];
  // The other two cells around the edge are across the facets that contain it.
  std::array<Triangulation::Cell_handle, 2> rest;
  for (int k = 0, r = 0; k < 4; ++k) {
    if (k != i && k != j) rest[static_cast<std::size_t>(r++)] = c->neighbor(k);
  }
  cgal_->triangulation.tds().flip_flippable(c, i, j);
  cgal_->free.push_back(cell);
  live_[cell] = 0;
  for (const auto changed : rest) cgal_->mirror(changed, cells_);
  return {rest[0]->info(), rest[1]->info()};
}

bool RegularTriangulation::is_edge(BeadId a, BeadId b) const {
  return cgal_->triangulation.tds().is_edge(cgal_->handle(a), cgal_->handle(b));
}

bool RegularTriangulation::is_facet(BeadId a, BeadId b, BeadId c) const {
  Triangulation::Cell_handle cell;
  int i = 0, j = 0, k = 0;
  return cgal_->triangulation.tds().is_facet(cgal_->handle(a), cgal_->handle(b), cgal_->handle(c), cell, i, j,
                                             k);
}

std::optional<CellId> RegularTriangulation::find_cell(const CellBeads& beads) const {
  for (const BeadId b : beads) {
    if (cgal_->handle(b) == Triangulation::Vertex_handle()) return std::nullopt;
  }
  Triangulation::Cell_handle c;
  const auto v = [&](std::size_t i) { return cgal_->handle(beads[i]); };
  int i = 0, j = 0, k = 0, l = 0;
  if (!cgal_->triangulation.tds().is_cell(v(0), v(1), v(2), v(3), c, i, j, k, l)) return std::nullopt;
  return c->info();
}

bool RegularTriangulation::is_valid() const { return cgal_->triangulation.is_valid(); }

int RegularTriangulation::least_orientation() const {
  int least = 1;
  for (const auto c : cgal_->triangulation.finite_cell_handles()) {
    least =
        std::min<int>(least, CGAL::orientation(c->vertex(0)->point().point(), c->vertex(1)->point().point(),
                                               c->vertex(2)->point().point(), c->vertex(3)->point().point()));
  }
  return least;
}

std::vector<CellBeads> RegularTriangulation::finite_cells() const {
  return sorted_finite_cells(cgal_->triangulation);
}

}  // namespace kds
