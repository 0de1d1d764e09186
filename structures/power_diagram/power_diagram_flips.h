#pragma once
// Part of PowerDiagram: flips. When a certificate fails, the Radon partition of the beads decides the flip.
// In general position the cells themselves tell which it is, for those among the beads change: in space 4-1
// if a vertex of the facet has just four cells, all among them, 3-2 if an edge has just three, else 2-3; in
// the plane 3-1 if a vertex has just three, else 2-2. What general position does not guarantee is checked:
// finite new cells must be positive just after the event, and on the hull the faces that go and those that
// come must turn the same way in their common plane now.

#include "structures/power_diagram/power_diagram.h"

namespace kds {

template <Motion M, Kernel K>
void PowerDiagram<M, K>::fail(unsigned table, std::uint32_t slot) {
  if (table >= appearing) return fail_hidden(table, slot);
  const FacetId place =
      table == 0 ? power_tests_.place_in_structure(slot) : orientations_.place_in_structure(slot);
  const CellId cell = cell_of(place);
  const int facet = index_of(place);
  triangulation_.fetch_around(cell, facet);
  fetch_scheduled(cell);
  fetch_scheduled(neighbor(cell, facet));
  const bool touch = table == 0 ? power_tests_.touches(slot) : orientations_.touches(slot);
  if (touch) suspect(Doubt::unclear);
  if (guard(cell, facet).about == About::cell) {
    set_own_guard(cell, facet, {CertificateHandle::violated, About::cell});
    if (!touch) return suspect(Doubt::wrong);  // cospherical cells turn over: no flip tells how to go on
    return watch_cell(cell, facet);
  }
  forget(cell, facet);
  if (doubt_ == Doubt::wrong) return;
  if (touch) {
    enqueue(cell, facet);
    return watch_enqueued();
  }
  begin_event(table == 0 ? power_tests_.identity(slot) : orientations_.identity(slot));
  repair(cell, facet);
  present_ = {};
}

template <Motion M, Kernel K>
void PowerDiagram<M, K>::fetch_cell(CellId cell, bool next) const {
  triangulation_.fetch(cell, next);
  if (!next) return;
  for (int i = 0; i <= dimension; ++i) {
    if (const FacetGuard facet = guard(cell, i); facet.about == About::power) power_tests_.fetch(facet.guard);
  }
  const auto& named = triangulation_.cells()[cell];
  for (const auto* beads : {&named.vertex, &named.apex}) {
    for (const BeadId bead : *beads) {
      if (bead != infinite_bead) __builtin_prefetch(motion_.control_point(bead, 0));
    }
  }
}

template <Motion M, Kernel K>
void PowerDiagram<M, K>::begin_event(const Identity& identity) {
  present_ = identity;
  if (simulator_.moment() == last_moment_ && present_ != last_identity_) suspect(Doubt::unclear);
  last_moment_ = simulator_.moment();
  last_identity_ = present_;
}

template <Motion M, Kernel K>
void PowerDiagram<M, K>::repair(CellId cell, int facet) {
  // Vertices of the facet across which both cells meet the same one: the others span a face that only cells
  // among the beads contain.
  const CellId other = neighbor(cell, facet);
  int met = 0;
  int across_from_face = 0;
  int in_all = 0;  // a vertex of the facet that is none of them
  for (int k = 0; k <= dimension; ++k) {
    if (k == facet) continue;
    if (neighbor(cell, k) == neighbor(other, place_of(other, vertex(cell, k)))) {
      ++met;
      across_from_face = k;
    } else {
      in_all = k;
    }
  }
  if (met == 0) return flip_to_edge(cell, facet);
  if (met == dimension - 1) return hide(cell, in_all);
  if constexpr (dimension == 3) {
    if (met == 1) return flip_to_facet(cell, facet, across_from_face);
  }
  suspect(Doubt::wrong);  // there are no other beads
}

/// Whether new cells may take the place of old ones.
template <Motion M, Kernel K>
bool PowerDiagram<M, K>::can_replace(std::span<const Beads> old, std::span<const Beads> made) {
  const Instant& now = simulator_.now();
  std::array<Orientation<dimension>, dimension + 1> finite;
  std::size_t count = 0;
  bool all_finite = true;
  for (const Beads& cell : made) {
    const Orientation<dimension> orientation(cell, 1);
    if (orientation.beads.back() == infinite_bead) {
      all_finite = false;
      continue;
    }
    if (orientation.identity() == present_) continue;  // flat now, and opening: that is the event
    finite[count++] = orientation;
  }
  if (!all_positive_now<K>(std::span<const Orientation<dimension>>(finite.data(), count), motion_, now,
                           statistics.stages)) {
    suspect(Doubt::unclear);
    for (std::size_t i = 0; i < count; ++i) {
      if (sign_just_after<K>(finite[i], motion_, now, statistics.stages) <= 0) return false;
    }
  }
  if (all_finite) return true;
  std::array<std::array<BeadId, dimension>, 2 * (dimension + 1)> hull;
  std::size_t on_hull = 0;
  for (const auto cells : {old, made}) {
    for (const Beads& cell : cells) {
      if (const auto face = hull_face<dimension>(cell)) hull[on_hull++] = *face;
    }
  }
  for (std::size_t t = 1; t < on_hull; ++t) {
    if (sign_now<K>(same_turn<dimension>(hull[0], hull[t]), motion_, now, statistics.stages) <= 0)
      return false;
  }
  return true;
}

template <Motion M, Kernel K>
bool PowerDiagram<M, K>::stands_already(std::span<const BeadId> face, CellId a, CellId b) const {
  // Infinity may have many cells.
  const BeadId bead = face[0] == infinite_bead ? face[1] : face[0];
  return triangulation_.stand_together(bead, place_of(a, bead) <= dimension ? a : b, face);
}

template <Motion M, Kernel K>
void PowerDiagram<M, K>::flip_to_edge(CellId cell, int facet) {
  const Beads v = triangulation_.cells()[cell].vertex;
  const BeadId d = v[static_cast<std::size_t>(facet)];
  const BeadId e = apex(cell, facet);
  const CellId other = neighbor(cell, facet);
  std::array<Beads, dimension> new_cells{};
  for (int k = 0, next = 0; k <= dimension; ++k) {
    if (k != facet) new_cells[static_cast<std::size_t>(next++)] = with(v, k, e);
  }
  const std::array<Beads, 2> old_cells{v, triangulation_.cells()[other].vertex};
  if (!can_replace(old_cells, new_cells) ||
      (may_stand_already() && stands_already(std::array{d, e}, cell, other))) {
    suspect(Doubt::wrong);
    return;
  }

  Change change{to_edge, dimension + 2, {}};
  std::size_t next = 0;
  for (const BeadId b : v) {
    if (b != d) change.ids[next++] = b;
  }
  std::sort(change.ids.begin(), change.ids.begin() + dimension);
  change.ids[dimension] = std::min(d, e);
  change.ids[dimension + 1] = std::max(d, e);

  displace(std::array{cell, other});
  for (int i = 0; i <= dimension; ++i) {
    if (i != facet) drop(cell, i);
    if (neighbor(other, i) != cell) drop(other, i);
  }
  const auto made = triangulation_.flip_facet(cell, facet);
  simulator_.record(index_, change);
  watch_around(made);
  rehouse(made[0]);
}

template <Motion M, Kernel K>
void PowerDiagram<M, K>::flip_to_facet(CellId cell, int facet, int other_vertex) requires(dimension == 3) {
  // The edge joins the facet's two vertices other than `other_vertex`; d, e and `other_vertex` make the new
  // facet.
  const Beads v = triangulation_.cells()[cell].vertex;
  const BeadId d = v[static_cast<std::size_t>(facet)];
  const BeadId e = apex(cell, facet);
  const BeadId c = v[static_cast<std::size_t>(other_vertex)];
  std::array<int, 2> edge{};
  std::size_t found = 0;
  for (int k = 0; k < 4; ++k) {
    if (k != facet && k != other_vertex) edge[found++] = k;
  }
  const std::array<CellId, 3> old{cell, neighbor(cell, facet), neighbor(cell, other_vertex)};
  std::array<Beads, 3> old_cells{};
  for (std::size_t o = 0; o < 3; ++o) old_cells[o] = triangulation_.cells()[old[o]].vertex;
  if (!can_replace(old_cells, std::array{with(v, edge[0], e), with(v, edge[1], e)}) ||
      (may_stand_already() && stands_already(std::array{c, d, e}, cell, old[1]))) {
    suspect(Doubt::wrong);
    return;
  }

  Change change{to_facet, 5, {c, d, e}};
  std::sort(change.ids.begin(), change.ids.begin() + 3);
  const auto [low, high] =
      std::minmax(v[static_cast<std::size_t>(edge[0])], v[static_cast<std::size_t>(edge[1])]);
  change.ids[3] = low;
  change.ids[4] = high;

  displace(old);
  for (const CellId o : old) {
    for (int i = 0; i < 4; ++i) drop(o, i);  // the second drop of an inner facet finds it gone
  }
  const std::array<CellId, 2> made = triangulation_.flip_edge(cell, edge[0], edge[1]);
  simulator_.record(index_, change);
  watch_around(made);
  rehouse(made[0]);
}

template <Motion M, Kernel K>
void PowerDiagram<M, K>::apply(const Change& change) {
  if (change.kind == rebuild) return apply_rebuild(change);
  if (change.kind > rebuild) return apply_edit(change);
  if (change.size != dimension + 2) throw std::invalid_argument("a flip has other numbers of beads");
  for (std::size_t i = 0; i < change.size; ++i) {
    if (change.ids[i] >= bead_count() && change.ids[i] != infinite_bead)
      throw std::invalid_argument("there is no bead " + std::to_string(change.ids[i]));
  }
  const auto& id = change.ids;
  if (change.kind == hides || change.kind == shows || change.kind == wanders) return apply_to_hidden(change);
  if constexpr (dimension == 3) {
    if (change.kind == to_facet) return apply_to_facet(change);
  }
  Beads beads{};
  std::copy(id.begin(), id.begin() + dimension + 1, beads.begin());
  const BeadId d = id[dimension];
  const BeadId e = id[dimension + 1];
  const auto cell = triangulation_.find_cell(beads);
  if (!cell) throw std::invalid_argument("the diagram has no such cell");
  const int facet = place_of(*cell, d);
  if (apex(*cell, facet) != e) throw std::invalid_argument("the facet has another apex");
  if (triangulation_.is_edge(d, e)) throw std::invalid_argument("the beads are joined already");
  triangulation_.flip_facet(*cell, facet);
}

template <Motion M, Kernel K>
void PowerDiagram<M, K>::apply_to_facet(const Change& change) requires(dimension == 3) {
  const auto& id = change.ids;
  const auto cell = triangulation_.find_cell({id[0], id[1], id[3], id[4]});
  if (!cell || !triangulation_.find_cell({id[0], id[2], id[3], id[4]}) ||
      !triangulation_.find_cell({id[1], id[2], id[3], id[4]})) {
    throw std::invalid_argument("the edge has other cells");
  }
  if (triangulation_.is_facet(id[0], id[1], id[2])) throw std::invalid_argument("the facet stands already");
  triangulation_.flip_edge(*cell, place_of(*cell, id[3]), place_of(*cell, id[4]));
}

/// Where hidden beads are is not followed.
template <Motion M, Kernel K>
void PowerDiagram<M, K>::apply_to_hidden(const Change& change) {
  const BeadId bead = change.kind == wanders ? change.ids[0] : change.ids[dimension + 1];
  Beads cell{};
  std::copy_n(change.ids.begin() + (change.kind == wanders ? 1 : 0), dimension + 1, cell.begin());
  if (bead == infinite_bead) throw std::invalid_argument("infinity is never hidden");
  if (hidden_.contains(bead) == (change.kind == hides))
    throw std::invalid_argument("bead " + std::to_string(bead) +
                                (change.kind == hides ? " is hidden already" : " is not hidden"));
  const auto stands = triangulation_.find_cell(cell);
  if (stands.has_value() == (change.kind == hides))
    throw std::invalid_argument(stands ? "the cell stands already" : "the diagram has no such cell");
  if (change.kind == shows) {
    triangulation_.flip_in(*stands, bead);
    hidden_.show(bead);
  } else if (change.kind == hides) {
    std::optional<CellId> part;
    for (int i = 0; i <= dimension; ++i) {
      part = triangulation_.find_cell(with(cell, i, bead));
      if (!part) throw std::invalid_argument("bead " + std::to_string(bead) + " has other cells");
    }
    triangulation_.flip_out(*part, place_of(*part, bead));
    hidden_.hide(bead);
  }
}

}  // namespace kds
