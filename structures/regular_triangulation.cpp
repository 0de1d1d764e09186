#include "structures/regular_triangulation.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <chrono>
#include <iterator>
#include <map>
#include <stdexcept>

#include "certificates/sorted_beads.h"
#include "motions/grow_little.h"
#include "structures/cgal_triangulations.h"
#include "structures/diagram_edges.h"

namespace kds {

namespace {

using Geometry = CGAL::Exact_predicates_inexact_constructions_kernel;
template <int Dimension>
using CgalOf = CgalTriangulation<Geometry, Dimension>;

template <int Dimension>
typename CgalOf<Dimension>::Type::Weighted_point weighted_point(const Eigen::Matrix3Xd& centers,
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
std::vector<CellBeads<Dimension>> sorted_finite_cells(const typename CgalOf<Dimension>::Type& triangulation) {
  std::vector<CellBeads<Dimension>> cells;
  if (triangulation.dimension() < Dimension) return cells;
  for (const auto c : CgalOf<Dimension>::finite_cells(triangulation)) cells.push_back(beads_of<Dimension>(c));
  sort_cells(cells);
  return cells;
}

}  // namespace

template <int Dimension>
StaticTriangulation<Dimension> static_triangulation(const Eigen::Matrix3Xd& centers,
                                                    std::span<const double> weights) {
  typename CgalOf<Dimension>::Type triangulation;
  insert_all<Dimension>(triangulation, centers, weights);
  return {sorted_finite_cells<Dimension>(triangulation), hidden_beads(triangulation, weights.size()),
          triangulation.dimension()};
}

template <int Dimension>
DiagramEdges static_edges(const Eigen::Matrix3Xd& centers, std::span<const double> weights) {
  typename CgalOf<Dimension>::Type triangulation;
  insert_all<Dimension>(triangulation, centers, weights);
  std::vector<BeadPairs::Pair> pairs;
  if (triangulation.dimension() >= 1) {
    for (const auto& edge : triangulation.finite_edges()) {
      const auto [a, b] = CgalOf<Dimension>::ends(edge);
      pairs.emplace_back(a->info(), b->info());
    }
  }
  return {BeadPairs(weights.size(), pairs), hidden_beads(triangulation, weights.size())};
}

template <int Dimension>
double seconds_to_triangulate(const Eigen::Matrix3Xd& centers, std::span<const double> weights) {
  std::vector<typename CgalOf<Dimension>::Type::Weighted_point> points;
  points.reserve(weights.size());
  for (std::size_t b = 0; b < weights.size(); ++b)
    points.push_back(weighted_point<Dimension>(centers, weights, b));
  const auto start = std::chrono::steady_clock::now();
  const typename CgalOf<Dimension>::Type triangulation(points.begin(), points.end());
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
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
  } else if (cgal_->triangulation.number_of_hidden_vertices() > 0) {
    std::vector<Beads> cells;
    for (const Cell& cell : cells_) cells.push_back(cell.vertex);
    assign(cgal_->vertex.size(), cells);
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
auto RegularTriangulation<Dimension>::meetings(std::span<const CellId> old, std::span<const Beads> made) const
    -> std::optional<std::vector<Meeting>> {
  struct Side {
    std::array<BeadId, Dimension> beads;
    FacetId facet;
    bool stays;
    bool even;  // of two cells that meet only one
  };
  std::vector<Side> sides;
  const auto add = [&sides](const Beads& v, int i, FacetId facet, bool stays) {
    Side side{{}, facet, stays, (Dimension - i) % 2 == 0};
    for (int j = 0, k = 0; j <= Dimension; ++j) {
      if (j != i) side.beads[static_cast<std::size_t>(k++)] = v[static_cast<std::size_t>(j)];
    }
    if (sort_beads(side.beads) < 0) side.even = !side.even;
    sides.push_back(side);
  };
  std::vector<CellId> gone(old.begin(), old.end());
  std::sort(gone.begin(), gone.end());
  if (std::adjacent_find(gone.begin(), gone.end()) != gone.end()) return std::nullopt;
  std::vector<BeadId> corners;
  for (const CellId c : old) {
    corners.insert(corners.end(), cells_[c].vertex.begin(), cells_[c].vertex.end());
    for (int i = 0; i <= Dimension; ++i) {
      const FacetId there = beyond(c, i);
      if (!std::binary_search(gone.begin(), gone.end(), cell_of(there)))
        add(cells_[cell_of(there)].vertex, index_of(there), there, true);
    }
  }
  std::sort(corners.begin(), corners.end());
  for (std::size_t m = 0; m < made.size(); ++m) {
    for (const BeadId b : made[m]) {
      if (std::count(made[m].begin(), made[m].end(), b) != 1) return std::nullopt;
      if (is_vertex(b) && !std::binary_search(corners.begin(), corners.end(), b)) return std::nullopt;
    }
    for (int i = 0; i <= Dimension; ++i) add(made[m], i, facet_id(static_cast<CellId>(m), i), false);
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return a.beads != b.beads ? a.beads < b.beads : a.stays < b.stays;
  });
  std::vector<Meeting> result;
  if (sides.size() % 2 != 0) return std::nullopt;
  for (std::size_t s = 0; s < sides.size(); s += 2) {
    const Side& a = sides[s];
    const Side& b = sides[s + 1];
    if (a.beads != b.beads || a.even == b.even || a.stays) return std::nullopt;
    if (s + 2 < sides.size() && sides[s + 2].beads == a.beads) return std::nullopt;
    result.push_back({a.facet, b.facet, b.stays});
  }
  return result;
}

template <int Dimension>
bool RegularTriangulation<Dimension>::fits(std::span<const CellId> old,
                                           std::span<const Beads> oriented_cells) const {
  return !oriented_cells.empty() && meetings(old, oriented_cells).has_value();
}

template <int Dimension>
std::vector<CellId> RegularTriangulation<Dimension>::replace(std::span<const CellId> old,
                                                             std::span<const Beads> oriented_cells) {
  using Types = typename Cgal::Types;
  const auto meeting = meetings(old, oriented_cells);
  if (!meeting || oriented_cells.empty()) throw std::logic_error("the cells to put in do not fit");
  auto& tds = cgal_->triangulation.tds();
  std::vector<BeadId> kept;
  for (const Beads& beads : oriented_cells) kept.insert(kept.end(), beads.begin(), beads.end());
  std::sort(kept.begin(), kept.end());
  std::vector<BeadId> left;  // vertices that have no cell any more
  for (const CellId c : old) {
    std::copy_if(cells_[c].vertex.begin(), cells_[c].vertex.end(), std::back_inserter(left),
                 [&](BeadId b) { return !std::binary_search(kept.begin(), kept.end(), b); });
  }
  std::sort(left.begin(), left.end());
  left.erase(std::unique(left.begin(), left.end()), left.end());
  std::vector<CellId> ids;
  std::vector<typename Cgal::CellHandle> made;
  for (const Beads& beads : oriented_cells) {
    const auto c = Types::create_cell(tds);
    for (int i = 0; i <= Dimension; ++i) {
      const BeadId b = beads[static_cast<std::size_t>(i)];
      const auto v = b == infinite_bead ? cgal_->triangulation.infinite_vertex() : cgal_->vertex_of(b);
      c->set_vertex(i, v);
      Types::set_cell(v, c);
    }
    made.push_back(c);
  }
  for (const Meeting& m : *meeting) {
    const auto a = made[cell_of(m.first)];
    const auto b = m.second_stays ? cgal_->cell[cell_of(m.second)] : made[cell_of(m.second)];
    a->set_neighbor(index_of(m.first), b);
    b->set_neighbor(index_of(m.second), a);
  }
  for (const CellId c : old) {
    for (const BeadId b : cells_[c].vertex) add_cells(b, -1);
    Types::delete_cell(tds, cgal_->cell[c]);
    cgal_->free.push_back(c);
    live_[c] = 0;
  }
  for (const BeadId b : left) {
    tds.delete_vertex(cgal_->vertex[b]);
    cgal_->vertex[b] = {};
  }
  for (const auto c : made) {
    ids.push_back(cgal_->new_id(c));
    enliven(ids.back());
    cells_[ids.back()] = {};  // the notes of a cell that was there before, too
  }
  cgal_->mirror(made, cells_);
  for (const CellId id : ids) {
    for (const BeadId b : cells_[id].vertex) add_cells(b, 1);
  }
  return ids;
}

template <int Dimension>
void RegularTriangulation<Dimension>::take_out(std::span<const BeadId> beads) requires(Dimension == 3) {
  for (const BeadId bead : beads) {
    cgal_->triangulation.remove(cgal_->vertex[bead]);
    cgal_->vertex[bead] = {};
  }
}

template <int Dimension>
void RegularTriangulation<Dimension>::put_in(std::span<const BeadId> beads, const Eigen::Matrix3Xd& centers,
                                             std::span<const double> weights) requires(Dimension == 3) {
  auto& triangulation = cgal_->triangulation;
  typename Cgal::VertexHandle last = triangulation.infinite_vertex();
  for (const BeadId bead : beads) {
    const auto hint = Cgal::Types::cell_beside(last);
    const auto v = triangulation.insert(weighted_point<Dimension>(centers, weights, bead), hint);
    if (v == typename Cgal::VertexHandle()) continue;
    last = v;
    if (v->info() == no_bead) v->info() = bead;  // else a coincident bead has it
  }
  cgal_->vertex.assign(weights.size(), {});
  for (const auto v : triangulation.finite_vertex_handles()) cgal_->vertex[v->info()] = v;
  forget_hidden_points();
}

template <int Dimension>
bool RegularTriangulation<Dimension>::is_solid() const requires(Dimension == 3) {
  return cgal_->triangulation.dimension() == Dimension;
}

template <int Dimension>
std::vector<CellId> RegularTriangulation<Dimension>::mirror_changes() requires(Dimension == 3) {
  std::fill(live_.begin(), live_.end(), 0);
  std::vector<typename Cgal::CellHandle> made;
  for (const auto c : Cgal::Types::all_cells(cgal_->triangulation)) {
    if (c->info() == no_cell) {
      made.push_back(c);
    } else {
      live_[c->info()] = 1;
    }
  }
  cgal_->free.clear();
  for (CellId id = 0; id < live_.size(); ++id) {
    if (live_[id] != 0) continue;
    cgal_->cell[id] = {};
    cgal_->free.push_back(id);
  }
  std::vector<CellId> ids;
  for (const auto c : made) ids.push_back(cgal_->new_id(c));
  for (const CellId id : ids) enliven(id);
  cgal_->mirror(made, cells_);
  count_cells();
  return ids;
}

template <int Dimension>
auto RegularTriangulation<Dimension>::sample(const Eigen::Matrix3Xd& centers, std::span<const double> weights,
                                             std::size_t stride) const -> Sample {
  Sample sample;
  const auto& triangulation = cgal_->triangulation;
  const auto infinite = triangulation.infinite_vertex();
  const auto moved = [&](typename Cgal::VertexHandle v) {
    return weighted_point<Dimension>(centers, weights, v->info());
  };
  for (std::size_t b = 0; b < cgal_->vertex.size(); b += stride) {
    if (cgal_->vertex[b] == typename Cgal::VertexHandle()) continue;
    // Beside a bead lies one of its latest cells: some way from there it may be any.
    auto c = Cgal::Types::cell_beside(cgal_->vertex[b]);
    for (std::size_t hop = 0; hop < 5; ++hop)
      c = c->neighbor(static_cast<int>((b / stride + hop * hop) % (Dimension + 1)));
    if (triangulation.is_infinite(c)) continue;
    for (int i = 0; i <= Dimension; ++i) {
      const auto n = c->neighbor(i);
      const auto apex = n->vertex(n->index(c));
      if (apex == infinite) continue;
      ++sample.tested;
      sample.failed += Cgal::Types::in_power_sphere(c, moved, moved(apex)) ? 1 : 0;
    }
  }
  return sample;
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
template StaticTriangulation<2> static_triangulation(const Eigen::Matrix3Xd&, std::span<const double>);
template StaticTriangulation<3> static_triangulation(const Eigen::Matrix3Xd&, std::span<const double>);
template DiagramEdges static_edges<2>(const Eigen::Matrix3Xd&, std::span<const double>);
template DiagramEdges static_edges<3>(const Eigen::Matrix3Xd&, std::span<const double>);
template double seconds_to_triangulate<2>(const Eigen::Matrix3Xd&, std::span<const double>);
template double seconds_to_triangulate<3>(const Eigen::Matrix3Xd&, std::span<const double>);

}  // namespace kds
