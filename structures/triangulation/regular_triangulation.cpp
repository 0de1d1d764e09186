#include "structures/triangulation/regular_triangulation.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <stdexcept>
#include <utility>

#include "motions/base/floating_point_scope.h"
#include "structures/triangulation/regular_triangulation_cgal.h"
#include "structures/triangulation/regular_triangulation_edits.h"
#include "structures/triangulation/regular_triangulation_flips.h"
#include "structures/triangulation/static_build.h"

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
  mirrored_ = points_wait_ = false;
  tell_of_all();
  cgal_->forget_changes();
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
    free_.clear();
    cgal_->cell.clear();
    count_cells();
    return;
  }
  mirror_all();
  forget_hidden_points();
}

/// CGAL stores hidden points in its cells, and flips would not keep these lists correct.
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
  mirrored_ = false;
  tell_of_all();
  cgal_->forget_changes();
  triangulation.clear();
  auto& tds = triangulation.tds();
  tds.clear();
  tds.set_dimension(Dimension);
  const auto infinite = tds.create_vertex();
  infinite->info() = infinite_bead;
  triangulation.set_infinite_vertex(infinite);
  cgal_->vertex.assign(beads, {});
  // Matches the two cells of each facet by the facet's beads.
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
  cgal_->forget_changes();
  cgal_->cell.clear();
  free_.clear();
  for (const auto c : Cgal::Types::all_cells(cgal_->triangulation))
    cgal_->name(c, static_cast<CellId>(cgal_->cell.size()));
  cells_.clear();
  cells_.reserve(cgal_->cell.size() + cgal_->cell.size() / 8 + 16);  // or the first flip moves them all
  cells_.assign(cgal_->cell.size(), {});
  live_.assign(cgal_->cell.size(), 1);
  cgal_->mirror(cgal_->cell, cells_);
  count_cells();
}

template <int Dimension>
auto RegularTriangulation<Dimension>::up_to_date() const -> Cgal& {
  if (mirrored_ && cgal_->is_behind()) cgal_->follow(cells_, live_, cells_at_);
  if (points_wait_) cgal_->put(points_);
  points_wait_ = false;
  return *cgal_;
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
  points_wait_ = false;
  for (std::size_t b = 0; b < up_to_date().vertex.size(); ++b) {
    if (cgal_->vertex[b] != typename Cgal::VertexHandle())
      cgal_->vertex[b]->set_point(weighted_point<Dimension>(centers, weights, b));
  }
}

template <int Dimension>
std::vector<CellId> RegularTriangulation<Dimension>::cells_around(BeadId bead) const {
  std::vector<CellId> cells;
  std::vector<typename Cgal::CellHandle> handles;
  const auto v = up_to_date().handle(bead);
  if constexpr (Dimension == 2) {
    auto c = up_to_date().triangulation.incident_faces(v);
    const auto first = c;
    do cells.push_back(c->info());
    while (++c != first);
  } else {
    up_to_date().triangulation.tds().incident_cells(v, std::back_inserter(handles));
    for (const auto c : handles) cells.push_back(c->info());
  }
  return cells;
}

template <int Dimension>
bool RegularTriangulation<Dimension>::stand_together(BeadId bead, CellId cell,
                                                     std::span<const BeadId> beads) const {
  grow_little(seen_, cells_.size());
  around_.assign(1, cell);
  seen_[cell] = 1;
  bool found = false;
  for (std::size_t k = 0; k < around_.size() && !found; ++k) {
    const Cell& c = cells_[around_[k]];
    found =
        std::all_of(beads.begin(), beads.end(), [&c](BeadId b) { return c.vertex_index(b) <= Dimension; });
    for (std::size_t i = 0; i <= Dimension; ++i) {
      if (c.vertex[i] == bead) continue;
      const CellId next = cell_of(c.beyond[i]);
      if (seen_[next] != 0) continue;
      seen_[next] = 1;
      around_.push_back(next);
    }
  }
  for (const CellId c : around_) seen_[c] = 0;
  return found;
}

template <int Dimension>
bool RegularTriangulation<Dimension>::is_vertex(BeadId bead) const {
  return up_to_date().handle(bead) != typename Cgal::VertexHandle();
}

template <int Dimension>
bool RegularTriangulation<Dimension>::is_edge(BeadId a, BeadId b) const {
  return is_vertex(a) && is_vertex(b) &&
         up_to_date().triangulation.tds().is_edge(up_to_date().handle(a), up_to_date().handle(b));
}

template <int Dimension>
bool RegularTriangulation<Dimension>::is_facet(BeadId a, BeadId b, BeadId c) const requires(Dimension == 3) {
  typename Cgal::CellHandle cell;
  int i = 0, j = 0, k = 0;
  return up_to_date().triangulation.tds().is_facet(up_to_date().handle(a), up_to_date().handle(b),
                                                   up_to_date().handle(c), cell, i, j, k);
}

template <int Dimension>
std::optional<CellId> RegularTriangulation<Dimension>::find_cell(const Beads& beads) const {
  for (const BeadId b : beads) {
    if (up_to_date().handle(b) == typename Cgal::VertexHandle()) return std::nullopt;
  }
  typename Cgal::CellHandle c;
  const auto v = [&](std::size_t i) { return up_to_date().handle(beads[i]); };
  bool found = false;
  if constexpr (Dimension == 2) {
    found = up_to_date().triangulation.tds().is_face(v(0), v(1), v(2), c);
  } else {
    int i = 0, j = 0, k = 0, l = 0;
    found = up_to_date().triangulation.tds().is_cell(v(0), v(1), v(2), v(3), c, i, j, k, l);
  }
  if (!found) return std::nullopt;
  return c->info();
}

template <int Dimension>
bool RegularTriangulation<Dimension>::is_valid() const {
  return up_to_date().triangulation.is_valid();
}

template <int Dimension>
auto RegularTriangulation<Dimension>::finite_cells() const -> std::vector<Beads> {
  return sorted_finite_cells<Dimension>(up_to_date().triangulation);
}

template <int Dimension>
auto RegularTriangulation<Dimension>::finite_edges() const -> std::vector<std::pair<BeadId, BeadId>> {
  std::vector<std::pair<BeadId, BeadId>> edges;
  const auto& triangulation = up_to_date().triangulation;
  if (triangulation.dimension() < 1) return edges;
  for (const auto& edge : triangulation.finite_edges()) {
    const auto [a, b] = Cgal::Types::ends(edge);
    edges.emplace_back(a->info(), b->info());
  }
  return edges;
}

template <int Dimension>
StaticTriangulation<Dimension> static_triangulation(const Eigen::Matrix3Xd& centers,
                                                    std::span<const double> weights) {
  const FloatingPointScope to_nearest;
  RegularTriangulation<Dimension> triangulation;
  auto built = triangulation.build_bare(centers, weights);
  built.cells = triangulation.finite_cells();
  return built;
}

template <int Dimension>
StaticBuild triangulation_by_cgal(const Eigen::Matrix3Xd& centers, std::span<const double> weights) {
  std::vector<typename CgalOf<Dimension>::Type::Weighted_point> points;
  points.reserve(weights.size());
  for (std::size_t b = 0; b < weights.size(); ++b)
    points.push_back(weighted_point<Dimension>(centers, weights, b));
  return [points = std::move(points)] {
    const FloatingPointScope to_nearest;
    const typename CgalOf<Dimension>::Type triangulation(points.begin(), points.end());
  };
}

template class RegularTriangulation<2>;
template class RegularTriangulation<3>;
template StaticTriangulation<2> static_triangulation(const Eigen::Matrix3Xd&, std::span<const double>);
template StaticTriangulation<3> static_triangulation(const Eigen::Matrix3Xd&, std::span<const double>);
template StaticBuild triangulation_by_cgal<2>(const Eigen::Matrix3Xd&, std::span<const double>);
template StaticBuild triangulation_by_cgal<3>(const Eigen::Matrix3Xd&, std::span<const double>);

}  // namespace kds
