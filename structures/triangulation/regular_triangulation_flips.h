#pragma once
// Part of RegularTriangulation: flips. Flips use only the mirror; CGAL's structure is updated when it is next
// used. A cell that exchanges one vertex keeps the indices of its other vertices, which determine the
// neighbour across each new facet.

#include "structures/triangulation/regular_triangulation_cgal.h"

namespace kds {

template <int Dimension>
CellId RegularTriangulation<Dimension>::new_cell() {
  CellId id = 0;
  if (free_.empty()) {
    id = static_cast<CellId>(cells_.size());
    append_little(cells_, {});
    append_little(live_, char{0});
  } else {
    id = free_.back();
    free_.pop_back();
  }
  live_[id] = 1;
  return id;
}

template <int Dimension>
void RegularTriangulation<Dimension>::free_cell(CellId id) {
  cgal_->change(id);
  live_[id] = 0;
  free_.push_back(id);
}

template <int Dimension>
void RegularTriangulation<Dimension>::exchange(CellId cell, const Cell& old, int i, BeadId bead) {
  cgal_->change(cell);
  cells_[cell].vertex = old.vertex;
  cells_[cell].vertex[static_cast<std::size_t>(i)] = bead;
}

template <int Dimension>
void RegularTriangulation<Dimension>::border(CellId cell, int i, const Cell& old, int k) {
  const auto here = static_cast<std::size_t>(i), was = static_cast<std::size_t>(k);
  const FacetId beyond = old.beyond[was];
  Cell& c = cells_[cell];
  Cell& outside = cells_[cell_of(beyond)];
  const auto there = static_cast<std::size_t>(index_of(beyond));
  c.beyond[here] = beyond;
  c.apex[here] = old.apex[was];
  outside.beyond[there] = facet_id(cell, i);
  outside.apex[there] = c.vertex[here];
}

template <int Dimension>
void RegularTriangulation<Dimension>::join(CellId a, int i, CellId b, int k) {
  const auto at_a = static_cast<std::size_t>(i), at_b = static_cast<std::size_t>(k);
  cells_[a].beyond[at_a] = facet_id(b, k);
  cells_[b].beyond[at_b] = facet_id(a, i);
  cells_[a].apex[at_a] = cells_[b].vertex[at_b];
  cells_[b].apex[at_b] = cells_[a].vertex[at_a];
}

template <int Dimension>
void RegularTriangulation<Dimension>::fetch(CellId cell, bool neighbors) const {
  if (!neighbors) return __builtin_prefetch(&cells_[cell], 1);
  for (const FacetId beyond : cells_[cell].beyond) __builtin_prefetch(&cells_[cell_of(beyond)], 1);
}

template <int Dimension>
void RegularTriangulation<Dimension>::fetch_around(CellId cell, int i) const {
  for (const CellId id : {cell, cell_of(beyond(cell, i))}) {
    for (int k = 0; k <= Dimension; ++k) __builtin_prefetch(&cells_[cell_of(beyond(id, k))], 1);
  }
}

template <int Dimension>
std::array<CellId, static_cast<std::size_t>(Dimension)> RegularTriangulation<Dimension>::flip_facet(
    CellId cell, int i) {
  const Cell here = cells_[cell];
  const CellId other = cell_of(here.beyond[static_cast<std::size_t>(i)]);
  const Cell there = cells_[other];
  const BeadId apex = here.apex[static_cast<std::size_t>(i)];
  add_cells(here.vertex[static_cast<std::size_t>(i)], Dimension - 1);
  add_cells(apex, Dimension - 1);
  std::array<CellId, static_cast<std::size_t>(Dimension)> made{cell, other};
  std::array<int, static_cast<std::size_t>(Dimension)> index{};  // indices of the facet's vertices
  for (int k = 0, n = 0; k <= Dimension; ++k) {
    if (k != i) index[static_cast<std::size_t>(n++)] = k;
  }
  if constexpr (Dimension == 3) {
    made[2] = new_cell();
  } else {
    for (const int k : index) add_cells(here.vertex[static_cast<std::size_t>(k)], -1);
  }
  for (std::size_t n = 0; n < made.size(); ++n) exchange(made[n], here, index[n], apex);
  for (std::size_t n = 0; n < made.size(); ++n) {
    border(made[n], index[n], here, index[n]);
    border(made[n], i, there, there.vertex_index(here.vertex[static_cast<std::size_t>(index[n])]));
    for (std::size_t m = 0; m < n; ++m) join(made[n], index[m], made[m], index[n]);
  }
  tell(std::array{cell, other}, made);
  return made;
}

template <int Dimension>
std::array<CellId, 2> RegularTriangulation<Dimension>::flip_edge(CellId cell, int i,
                                                                 int j) requires(Dimension == 3) {
  const Cell here = cells_[cell];
  const std::array<int, 2> end{i, j};
  std::array<int, 2> index{};  // indices of the other vertices; the other cells are across from these
  for (int k = 0, n = 0; k < 4; ++k) {
    if (k != i && k != j) index[static_cast<std::size_t>(n++)] = k;
  }
  const auto beside = [&](std::size_t n) { return cell_of(here.beyond[static_cast<std::size_t>(index[n])]); };
  const std::array<CellId, 2> made{beside(0), beside(1)};
  const std::array<Cell, 2> there{cells_[made[0]], cells_[made[1]]};
  const BeadId apex = here.apex[static_cast<std::size_t>(index[0])];
  free_cell(cell);
  for (std::size_t n = 0; n < 2; ++n) {
    add_cells(here.vertex[static_cast<std::size_t>(end[n])], -2);
    exchange(made[n], here, end[n], apex);
  }
  for (std::size_t n = 0; n < 2; ++n) {
    border(made[n], end[n], here, end[n]);
    const BeadId gone = here.vertex[static_cast<std::size_t>(end[n])];
    for (std::size_t m = 0; m < 2; ++m) border(made[n], index[m], there[m], there[m].vertex_index(gone));
  }
  join(made[0], j, made[1], i);
  tell(std::array{cell, made[0], made[1]}, made);
  return made;
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
  for (const BeadId b : cells_[cell].vertex) add_cells(b, Dimension - 1);
  add_cells(bead, Dimension + 1);
  cgal_->turn(bead);
  Star made{cell};
  for (std::size_t k = 1; k <= Dimension; ++k) made[k] = new_cell();
  const Cell here = cells_[cell];
  for (int k = 0; k <= Dimension; ++k) exchange(made[static_cast<std::size_t>(k)], here, k, bead);
  for (int k = 0; k <= Dimension; ++k) {
    border(made[static_cast<std::size_t>(k)], k, here, k);
    for (int m = 0; m < k; ++m)
      join(made[static_cast<std::size_t>(k)], m, made[static_cast<std::size_t>(m)], k);
  }
  tell(std::array{cell}, made);
  return made;
}

template <int Dimension>
CellId RegularTriangulation<Dimension>::flip_out(CellId cell, int i) {
  const Cell here = cells_[cell];
  const Star old = star(cell, i);
  const BeadId gone = here.vertex[static_cast<std::size_t>(i)];
  // The cells share all vertices but one, which is the vertex beyond the facet of each.
  const BeadId apex = here.apex[i == 0 ? 1 : 0];
  add_cells(gone, -(Dimension + 1));
  cgal_->turn(gone);
  add_cells(apex, 1 - Dimension);
  exchange(cell, here, i, apex);
  border(cell, i, here, i);
  for (int k = 0; k <= Dimension; ++k) {
    if (k == i) continue;
    add_cells(here.vertex[static_cast<std::size_t>(k)], 1 - Dimension);
    const CellId beside = cell_of(here.beyond[static_cast<std::size_t>(k)]);
    border(cell, k, cells_[beside], cells_[beside].vertex_index(gone));
    free_cell(beside);
  }
  tell(old, std::array{cell});
  return cell;
}

}  // namespace kds
