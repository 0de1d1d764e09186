#include "structures/regular_triangulation.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <stdexcept>

#include "structures/regular_triangulation_cgal.h"
#include "structures/regular_triangulation_edits.h"

namespace kds {

template <int Dimension>
RegularTriangulation<Dimension>::RegularTriangulation() : cgal_(std::make_unique<Cgal>()) {}
template <int Dimension>
RegularTriangulation<Dimension>::~RegularTriangulation() = default;

template <int Dimension>
StaticTriangulation<Dimension> RegularTriangulation<Dimension>::build(const Eigen::Matrix3Xd& centers,
                                                                      std::span<const double> weights) {
  auto built = build_bare(centers, weights);
  make_mirror();
  return built;
}

template <int Dimension>
StaticTriangulation<Dimension> RegularTriangulation<Dimension>::build_bare(const Eigen::Matrix3Xd& centers,
                                                                           std::span<const double> weights) {
  mirrored_ = false;
  auto& triangulation = cgal_->triangulation;
  triangulation.clear();
  insert_all<Dimension>(triangulation, centers, weights);
  triangulation.infinite_vertex()->info() = infinite_bead;
  cgal_->vertex.assign(weights.size(), {});
  for (const auto v : triangulation.finite_vertex_handles()) cgal_->vertex[v->info()] = v;
  return {{}, hidden_beads(triangulation, weights.size()), triangulation.dimension()};
}

template <int Dimension>
void RegularTriangulation<Dimension>::make_mirror() {
  if (mirrored_) return;
  mirrored_ = true;
  if (cgal_->triangulation.dimension() < Dimension) {
    cells_.clear();
    live_.clear();
    return;
  }
  mirror_all();
  forget_hidden_points();
}

/// CGAL keeps hidden points with its cells, which flips would not keep up.
template <int Dimension>
void RegularTriangulation<Dimension>::forget_hidden_points() {
  if constexpr (Dimension == 3) {
    if (cgal_->triangulation.number_of_vertices() == cgal_->vertex.size()) return;
    for (const auto c : Cgal::Types::all_cells(cgal_->triangulation)) {
      while (c->hidden_points_begin() != c->hidden_points_end()) c->unhide_point(c->hidden_points_begin());
    }
  } else {
    std::vector<typename Cgal::VertexHandle> hidden;
    for (const auto v : cgal_->triangulation.hidden_vertex_handles()) hidden.push_back(v);
    for (const auto v : hidden) cgal_->triangulation.remove(v);
  }
}

template <int Dimension>
void RegularTriangulation<Dimension>::assign(std::size_t beads, std::span<const Beads> oriented_cells) {
  using Types = typename Cgal::Types;
  auto& triangulation = cgal_->triangulation;
  std::vector<typename Cgal::Triangulation::Weighted_point> points(beads);
  for (std::size_t b = 0; b < beads && b < cgal_->vertex.size(); ++b) {
    if (cgal_->vertex[b] != typename Cgal::VertexHandle()) points[b] = cgal_->vertex[b]->point();
  }
  triangulation.clear();
  auto& tds = triangulation.tds();
  tds.clear();
  tds.set_dimension(Dimension);
  const auto infinite = tds.create_vertex();
  infinite->info() = infinite_bead;
  triangulation.set_infinite_vertex(infinite);
  cgal_->vertex.assign(beads, {});
  // Facets of two cells meet here by their beads.
  std::map<std::array<BeadId, Dimension>, std::pair<typename Cgal::CellHandle, int>> open;
  for (const Beads& beads_of_cell : oriented_cells) {
    const auto c = Types::create_cell(tds);
    for (int i = 0; i <= Dimension; ++i) {
      const BeadId b = beads_of_cell[static_cast<std::size_t>(i)];
      const auto v = b == infinite_bead ? infinite : cgal_->vertex_of(b);
      if (b != infinite_bead) v->set_point(points[b]);
      c->set_vertex(i, v);
      Types::set_cell(v, c);
    }
    for (int i = 0; i <= Dimension; ++i) {
      std::array<BeadId, Dimension> facet{};
      for (int j = 0, k = 0; j <= Dimension; ++j) {
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
  mirrored_ = true;
  mirror_all();
}

template <int Dimension>
void RegularTriangulation<Dimension>::mirror_all() {
  cgal_->cell.clear();
  cgal_->free.clear();
  for (const auto c : Cgal::Types::all_cells(cgal_->triangulation)) cgal_->new_id(c);
  cells_.assign(cgal_->cell.size(), {});
  live_.assign(cgal_->cell.size(), 1);
  cgal_->mirror(cgal_->cell, cells_);
  count_cells();
}

template <int Dimension>
void RegularTriangulation<Dimension>::count_cells() {
  cells_at_.assign(cgal_->vertex.size(), 0);
  for (CellId cell = 0; cell < cells_.size(); ++cell) {
    if (!is_live(cell)) continue;
    for (const BeadId b : cells_[cell].vertex) add_cells(b, 1);
  }
}

template <int Dimension>
void RegularTriangulation<Dimension>::set_points(const Eigen::Matrix3Xd& centers,
                                                 std::span<const double> weights) {
  for (std::size_t b = 0; b < cgal_->vertex.size(); ++b) {
    if (cgal_->vertex[b] != typename Cgal::VertexHandle())
      cgal_->vertex[b]->set_point(weighted_point<Dimension>(centers, weights, b));
  }
}

template <int Dimension>
void RegularTriangulation<Dimension>::set_points(const Placement<Dimension>& placement) {
  for (BeadId b = 0; b < cgal_->vertex.size(); ++b) {
    if (cgal_->vertex[b] == typename Cgal::VertexHandle()) continue;
    const double* c = placement.control_point(b, 0);
    cgal_->vertex[b]->set_point({Cgal::Types::point(c[0], c[1], c[2]), placement.weight(b, 0)});
  }
}

template <int Dimension>
void RegularTriangulation<Dimension>::enliven(CellId id) {
  if (id == cells_.size()) {
    append_little(cells_, {});
    append_little(live_, char{0});
  }
  live_[id] = 1;
}

template <int Dimension>
void RegularTriangulation<Dimension>::fetch_around(CellId cell, int i) const {
  const auto fetch = [this](CellId id) {
    __builtin_prefetch(&cells_[id], 1);
    const auto* c = &*cgal_->cell[id];
    __builtin_prefetch(c, 1);
    __builtin_prefetch(reinterpret_cast<const char*>(c) + 64, 1);
  };
  for (const CellId id : {cell, cell_of(beyond(cell, i))}) {
    fetch(id);
    for (int k = 0; k <= Dimension; ++k) fetch(cell_of(beyond(id, k)));
  }
}

template <int Dimension>
std::array<CellId, static_cast<std::size_t>(Dimension)> RegularTriangulation<Dimension>::flip_facet(
    CellId cell, int i) {
  const auto c = cgal_->cell[cell];
  const auto n = c->neighbor(i);
  constexpr int more_at_apices = Dimension - 1;
  add_cells(cells_[cell].vertex[static_cast<std::size_t>(i)], more_at_apices);
  add_cells(apex_beyond(cell, i), more_at_apices);
  if constexpr (Dimension == 2) {
    for (int k = 0; k < 3; ++k) {
      if (k != i) add_cells(cells_[cell].vertex[static_cast<std::size_t>(k)], -1);
    }
    cgal_->triangulation.tds().flip(c, i);
    cgal_->mirror(std::array{c, n}, cells_);
    return {cell, n->info()};
  } else {
    const int i2 = (i + 2) & 3;
    cgal_->triangulation.tds().flip_flippable(c, i);
    // The new cell is across the facet that CGAL leaves opposite to the place of the second vertex after i.
    const auto made = c->neighbor(i2);
    const CellId id = cgal_->new_id(made);
    enliven(id);
    cgal_->mirror(std::array{c, n, made}, cells_);
    return {cell, n->info(), id};
  }
}

template <int Dimension>
std::array<CellId, 2> RegularTriangulation<Dimension>::flip_edge(CellId cell, int i,
                                                                 int j) requires(Dimension == 3) {
  const auto c = cgal_->cell[cell];
  // The other two cells around the edge are across the facets that contain it.
  std::array<typename Cgal::CellHandle, 2> rest;
  for (const int end : {i, j}) add_cells(cells_[cell].vertex[static_cast<std::size_t>(end)], -2);
  for (int k = 0, r = 0; k < 4; ++k) {
    if (k != i && k != j) rest[static_cast<std::size_t>(r++)] = c->neighbor(k);
  }
  cgal_->triangulation.tds().flip_flippable(c, i, j);
  cgal_->free.push_back(cell);
  live_[cell] = 0;
  cgal_->mirror(rest, cells_);
  return {rest[0]->info(), rest[1]->info()};
}

template <int Dimension>
auto RegularTriangulation<Dimension>::star(CellId cell, int i) const -> Star {
  Star cells{cell};
  for (int k = 0, next = 1; k <= Dimension; ++k) {
    if (k != i) cells[static_cast<std::size_t>(next++)] = cell_of(beyond(cell, k));
  }
  return cells;
}

template <int Dimension>
auto RegularTriangulation<Dimension>::flip_in(CellId cell, BeadId bead) -> Star {
  const auto c = cgal_->cell[cell];
  auto& tds = cgal_->triangulation.tds();
  for (const BeadId b : cells_[cell].vertex) add_cells(b, Dimension - 1);
  add_cells(bead, Dimension + 1);
  typename Cgal::VertexHandle v;
  if constexpr (Dimension == 2) {
    v = tds.insert_in_face(c);
  } else {
    v = tds.insert_in_cell(c);
  }
  v->info() = bead;
  cgal_->vertex[bead] = v;
  const int i = c->index(v);
  std::array<typename Cgal::CellHandle, Dimension + 1> around{c};
  for (int k = 0, next = 1; k <= Dimension; ++k) {
    if (k == i) continue;
    enliven(cgal_->new_id(c->neighbor(k)));
    around[static_cast<std::size_t>(next++)] = c->neighbor(k);
  }
  cgal_->mirror(around, cells_);
  return star(cell, i);
}

template <int Dimension>
CellId RegularTriangulation<Dimension>::flip_out(CellId cell, int i) {
  const auto c = cgal_->cell[cell];
  const auto v = c->vertex(i);
  cgal_->vertex[v->info()] = {};
  for (int k = 0; k <= Dimension; ++k) {
    const auto at = static_cast<std::size_t>(k);
    add_cells(cells_[cell].vertex[at], k == i ? -(Dimension + 1) : 1 - Dimension);
  }
  // The cells share all but one vertex: the one beyond the facet of each.
  add_cells(apex_beyond(cell, i == 0 ? 1 : 0), 1 - Dimension);
  for (const CellId gone : star(cell, i)) {
    live_[gone] = 0;
    if (gone != cell) cgal_->free.push_back(gone);
  }
  auto& tds = cgal_->triangulation.tds();
  if constexpr (Dimension == 2) {
    tds.remove_degree_3(v, c);
  } else {
    cgal_->cell[cell] = tds.remove_from_maximal_dimension_simplex(v);
    cgal_->cell[cell]->info() = cell;
  }
  enliven(cell);
  cgal_->mirror(std::array{cgal_->cell[cell]}, cells_);
  return cell;
}

template <int Dimension>
std::vector<CellId> RegularTriangulation<Dimension>::cells_around(BeadId bead) const {
  std::vector<CellId> cells;
  std::vector<typename Cgal::CellHandle> handles;
  const auto v = cgal_->handle(bead);
  if constexpr (Dimension == 2) {
    auto c = cgal_->triangulation.incident_faces(v);
    const auto first = c;
    do cells.push_back(c->info());
    while (++c != first);
  } else {
    cgal_->triangulation.tds().incident_cells(v, std::back_inserter(handles));
    for (const auto c : handles) cells.push_back(c->info());
  }
  return cells;
}

template <int Dimension>
bool RegularTriangulation<Dimension>::is_vertex(BeadId bead) const {
  return cgal_->handle(bead) != typename Cgal::VertexHandle();
}

template <int Dimension>
bool RegularTriangulation<Dimension>::is_edge(BeadId a, BeadId b) const {
  return is_vertex(a) && is_vertex(b) &&
         cgal_->triangulation.tds().is_edge(cgal_->handle(a), cgal_->handle(b));
}

template <int Dimension>
bool RegularTriangulation<Dimension>::is_facet(BeadId a, BeadId b, BeadId c) const requires(Dimension == 3) {
  typename Cgal::CellHandle cell;
  int i = 0, j = 0, k = 0;
  return cgal_->triangulation.tds().is_facet(cgal_->handle(a), cgal_->handle(b), cgal_->handle(c), cell, i, j,
                                             k);
}

template <int Dimension>
std::optional<CellId> RegularTriangulation<Dimension>::find_cell(const Beads& beads) const {
  for (const BeadId b : beads) {
    if (cgal_->handle(b) == typename Cgal::VertexHandle()) return std::nullopt;
  }
  typename Cgal::CellHandle c;
  const auto v = [&](std::size_t i) { return cgal_->handle(beads[i]); };
  bool found = false;
  if constexpr (Dimension == 2) {
    found = cgal_->triangulation.tds().is_face(v(0), v(1), v(2), c);
  } else {
    int i = 0, j = 0, k = 0, l = 0;
    found = cgal_->triangulation.tds().is_cell(v(0), v(1), v(2), v(3), c, i, j, k, l);
  }
  if (!found) return std::nullopt;
  return c->info();
}

template <int Dimension>
bool RegularTriangulation<Dimension>::is_valid() const {
  return cgal_->triangulation.is_valid();
}

template <int Dimension>
int RegularTriangulation<Dimension>::least_orientation() const {
  int least = 1;
  for (const auto c : Cgal::Types::finite_cells(cgal_->triangulation))
    least = std::min(least, Cgal::Types::orientation(c));
  return least;
}

template <int Dimension>
auto RegularTriangulation<Dimension>::finite_cells() const -> std::vector<Beads> {
  return sorted_finite_cells<Dimension>(cgal_->triangulation);
}

template class RegularTriangulation<2>;
template class RegularTriangulation<3>;

}  // namespace kds
