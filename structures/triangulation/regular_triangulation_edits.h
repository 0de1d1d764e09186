#pragma once
// Part of RegularTriangulation: replaces cells by others, and removes and inserts beads.

#include <algorithm>
#include <iterator>
#include <random>
#include <stdexcept>

#include "certificates/base/certificate_type.h"
#include "structures/triangulation/regular_triangulation_cgal.h"

namespace kds {

template <int Dimension>
auto RegularTriangulation<Dimension>::meetings(std::span<const CellId> old, std::span<const Beads> made) const
    -> std::optional<std::vector<Meeting>> {
  struct Side {
    std::array<BeadId, Dimension> beads;
    FacetId facet;
    bool stays;
    bool even;  // true for exactly one of two cells that match
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
      if (b != infinite_bead && is_vertex(b) && !std::binary_search(corners.begin(), corners.end(), b))
        return std::nullopt;
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
  auto& tds = up_to_date().triangulation.tds();
  std::vector<BeadId> kept;
  for (const Beads& beads : oriented_cells) kept.insert(kept.end(), beads.begin(), beads.end());
  std::sort(kept.begin(), kept.end());
  std::vector<BeadId> left;  // vertices that lose all their cells
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
    cgal_->cell[c] = {};
    free_.push_back(c);
    live_[c] = 0;
  }
  for (const BeadId b : left) {
    tds.delete_vertex(cgal_->vertex[b]);
    cgal_->vertex[b] = {};
  }
  for (const auto c : made) {
    ids.push_back(new_cell());
    cgal_->name(c, ids.back());
    cells_[ids.back()] = {};  // also clears the notes of an earlier cell
  }
  cgal_->mirror(made, cells_);
  for (const CellId id : ids) {
    for (const BeadId b : cells_[id].vertex) add_cells(b, 1);
  }
  tell(old, ids, false);
  return ids;
}

template <int Dimension>
void RegularTriangulation<Dimension>::take_out(std::span<const BeadId> beads) {
  for (const BeadId bead : beads) {
    up_to_date().triangulation.remove(cgal_->vertex[bead]);
    cgal_->vertex[bead] = {};
  }
}

template <int Dimension>
void RegularTriangulation<Dimension>::put_in(std::span<const BeadId> beads, const Eigen::Matrix3Xd& centers,
                                             std::span<const double> weights) {
  auto& triangulation = up_to_date().triangulation;
  typename Cgal::VertexHandle last = triangulation.infinite_vertex();
  for (const BeadId bead : beads) {
    const auto hint = Cgal::Types::cell_beside(last);
    const auto v = triangulation.insert(weighted_point<Dimension>(centers, weights, bead), hint);
    if (v == typename Cgal::VertexHandle()) continue;
    last = v;
    if (v->info() == no_bead) v->info() = bead;  // otherwise a coincident bead has this vertex
  }
  cgal_->vertex.assign(weights.size(), {});
  for (const auto v : triangulation.finite_vertex_handles()) cgal_->vertex[v->info()] = v;
  forget_hidden_points();
}

template <int Dimension>
bool RegularTriangulation<Dimension>::is_solid() const {
  return up_to_date().triangulation.dimension() == Dimension;
}

template <int Dimension>
std::vector<CellId> RegularTriangulation<Dimension>::mirror_changes() {
  std::fill(live_.begin(), live_.end(), 0);
  std::vector<typename Cgal::CellHandle> made;
  for (const auto c : Cgal::Types::all_cells(cgal_->triangulation)) {
    // In the plane, CGAL reuses a cell for other beads: such a cell is new.
    if (c->info() != no_cell && beads_of<Dimension>(c) != cells_[c->info()].vertex) c->info() = no_cell;
    if (c->info() == no_cell) {
      made.push_back(c);
    } else {
      live_[c->info()] = 1;
    }
  }
  free_.clear();
  for (CellId id = 0; id < live_.size(); ++id) {
    if (live_[id] != 0) continue;
    cgal_->cell[id] = {};
    free_.push_back(id);
  }
  std::vector<CellId> ids;
  for (const auto c : made) {
    ids.push_back(new_cell());
    cells_[ids.back()] = {};  // also clears the notes of an earlier cell
    cgal_->name(c, ids.back());
  }
  cgal_->mirror(made, cells_);
  count_cells();
  tell_of_all();
  return ids;
}

template <int Dimension>
auto RegularTriangulation<Dimension>::sample(const Eigen::Matrix3Xd& centers, std::span<const double> weights,
                                             std::size_t stride, std::uint64_t turn) const -> Sample {
  if (mirrored_) return sample_mirror(centers, weights, stride, turn);
  Sample sample;
  const auto& triangulation = cgal_->triangulation;
  const auto infinite = triangulation.infinite_vertex();
  const auto moved = [&](BeadId bead) { return weighted_point<Dimension>(centers, weights, bead); };
  for (std::size_t b = turn % stride; b < cgal_->vertex.size(); b += stride) {
    if (cgal_->vertex[b] == typename Cgal::VertexHandle()) continue;
    // The cell stored at a vertex is one of its latest cells, which fail more often than others. After enough
    // hops on a random walk, any cell may be reached.
    auto c = Cgal::Types::cell_beside(cgal_->vertex[b]);
    std::minstd_rand turns(static_cast<std::minstd_rand::result_type>(b + 1));
    turns.discard(2);  // the first numbers of similar seeds are similar
    for (std::size_t hop = 0; hop < 20; ++hop)
      c = c->neighbor(static_cast<int>(turns() / 64 % (Dimension + 1)));
    if (triangulation.is_infinite(c)) continue;
    const Beads cell = beads_of<Dimension>(c);
    for (int i = 0; i <= Dimension; ++i) {
      const auto n = c->neighbor(i);
      const auto apex = n->vertex(n->index(c));
      if (apex == infinite) continue;
      ++sample.tested;
      sample.failed += Cgal::Types::in_power_sphere(cell, moved, moved(apex->info())) ? 1 : 0;
    }
  }
  return sample;
}

template <int Dimension>
auto RegularTriangulation<Dimension>::sample_mirror(const Eigen::Matrix3Xd& centers,
                                                    std::span<const double> weights, std::size_t stride,
                                                    std::uint64_t turn) const -> Sample {
  Sample sample;
  if (cells_.empty()) return sample;
  const auto moved = [&](BeadId bead) { return weighted_point<Dimension>(centers, weights, bead); };
  const std::size_t count = (weights.size() + stride - 1) / stride;
  const std::size_t first = turn * 0x9e3779b1U % cells_.size();
  for (std::size_t k = 0; k < count; ++k) {
    const auto id = static_cast<CellId>((k * cells_.size() + first) / count);
    const Cell& cell = cells_[id];
    if (!is_live(id) || cell.vertex_index(infinite_bead) <= Dimension) continue;
    for (const BeadId apex : cell.apex) {
      if (apex == infinite_bead) continue;
      ++sample.tested;
      sample.failed += Cgal::Types::in_power_sphere(cell.vertex, moved, moved(apex)) ? 1 : 0;
    }
  }
  return sample;
}

}  // namespace kds
