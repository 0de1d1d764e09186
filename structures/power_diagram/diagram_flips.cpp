#include "structures/power_diagram/diagram_flips.h"

#include <algorithm>
#include <array>
#include <optional>
#include <stdexcept>
#include <string>

#include "structures/triangulation/facet_certificate.h"

namespace kds {

template <int Dimension>
void DiagramFlips<Dimension>::fail(unsigned table, std::uint32_t slot) {
  state_.vanished_until = state_.simulator.now().upper();
  if (table < HiddenCertificates<Dimension>::appearing) {
    const auto failed = facets_.take_failure(table, slot);
    if (!failed) return;
    begin_event(failed->identity);
    repair(failed->cell, failed->facet);
  } else {
    const auto failed = hidden_.take_failure(table, slot);
    if (!failed) return;
    begin_event(failed->identity);
    const CellId host = state_.hidden.host(failed->bead);
    if (!failed->facet) {
      show(failed->bead, host);
    } else if (const CellId beyond = state_.neighbor(host, *failed->facet); state_.is_infinite(beyond)) {
      show(failed->bead, beyond);
    } else {
      hidden_.wander(failed->bead, *failed->facet);
    }
  }
  state_.present = {};
}

template <int Dimension>
void DiagramFlips<Dimension>::begin_event(const Identity& identity) {
  state_.present = identity;
  if (state_.simulator.moment() == last_moment_ && identity != last_identity_) state_.suspect(Doubt::unclear);
  last_moment_ = state_.simulator.moment();
  last_identity_ = identity;
}

template <int Dimension>
void DiagramFlips<Dimension>::repair(CellId cell, int facet) {
  // Find the vertices of the facet across which both cells have the same neighbour. The other beads span a
  // face that is contained only in cells among these beads.
  const CellId other = state_.neighbor(cell, facet);
  int met = 0;
  int across_from_face = 0;
  int in_all = 0;  // a vertex of the facet without such a neighbour
  for (int k = 0; k <= Dimension; ++k) {
    if (k == facet) continue;
    if (state_.neighbor(cell, k) ==
        state_.neighbor(other, state_.vertex_index(other, state_.vertex(cell, k)))) {
      ++met;
      across_from_face = k;
    } else {
      in_all = k;
    }
  }
  if (met == 0) return flip_to_edge(cell, facet);
  if (met == Dimension - 1) return hide(cell, in_all);
  if constexpr (Dimension == 3) {
    if (met == 1) return flip_to_facet(cell, facet, across_from_face);
  }
  state_.suspect(Doubt::wrong);  // all neighbours are shared: there are no other vertices
}

/// Returns whether the new cells may take the place of the old ones.
template <int Dimension>
bool DiagramFlips<Dimension>::can_replace(std::span<const Beads> old, std::span<const Beads> made) {
  std::array<Orientation<Dimension>, Dimension + 1> finite;
  std::size_t count = 0;
  bool all_finite = true;
  for (const Beads& cell : made) {
    const Orientation<Dimension> orientation(cell, 1);
    if (orientation.beads.back() == infinite_bead) {
      all_finite = false;
      continue;
    }
    if (orientation.identity() == state_.present) continue;  // flat now, and opening
    finite[count++] = orientation;
  }
  if (!state_.all_positive_now({finite.data(), count})) {
    state_.suspect(Doubt::unclear);
    for (std::size_t i = 0; i < count; ++i) {
      if (state_.sign_just_after(finite[i]) <= 0) return false;
    }
  }
  if (all_finite) return true;
  std::array<std::array<BeadId, Dimension>, 2 * (Dimension + 1)> hull;
  std::size_t on_hull = 0;
  for (const auto cells : {old, made}) {
    for (const Beads& cell : cells) {
      if (const auto face = hull_face<Dimension>(cell)) hull[on_hull++] = *face;
    }
  }
  for (std::size_t t = 1; t < on_hull; ++t) {
    if (state_.sign_now(same_turn<Dimension>(hull[0], hull[t])) <= 0) return false;
  }
  return true;
}

/// Returns whether a face of these beads exists already. Each bead must be a vertex of one of the two cells.
template <int Dimension>
bool DiagramFlips<Dimension>::stands_already(std::span<const BeadId> face, CellId a, CellId b) const {
  // Start from a finite bead, because the infinite vertex may have many cells.
  const BeadId bead = face[0] == infinite_bead ? face[1] : face[0];
  return state_.triangulation.stand_together(bead, state_.vertex_index(a, bead) <= Dimension ? a : b, face);
}

template <int Dimension>
void DiagramFlips<Dimension>::flip_to_edge(CellId cell, int facet) {
  const Beads v = state_.beads_of(cell);
  const BeadId d = v[static_cast<std::size_t>(facet)];
  const BeadId e = state_.apex(cell, facet);
  const CellId other = state_.neighbor(cell, facet);
  std::array<Beads, Dimension> new_cells{};
  for (int k = 0, next = 0; k <= Dimension; ++k) {
    if (k != facet) new_cells[static_cast<std::size_t>(next++)] = State::with(v, k, e);
  }
  const std::array<Beads, 2> old_cells{v, state_.beads_of(other)};
  if (!can_replace(old_cells, new_cells) ||
      (may_stand_already() && stands_already(std::array{d, e}, cell, other))) {
    state_.suspect_at(cell, other);
    return;
  }

  Change change{Events::to_edge, Dimension + 2, {}};
  std::size_t next = 0;
  for (const BeadId b : v) {
    if (b != d) change.ids[next++] = b;
  }
  std::sort(change.ids.begin(), change.ids.begin() + Dimension);
  change.ids[Dimension] = std::min(d, e);
  change.ids[Dimension + 1] = std::max(d, e);

  hidden_.displace(std::array{cell, other});
  for (int i = 0; i <= Dimension; ++i) {
    if (i != facet) facets_.drop(cell, i);
    if (state_.neighbor(other, i) != cell) facets_.drop(other, i);
  }
  const auto made = state_.triangulation.flip_facet(cell, facet);
  state_.record(change);
  facets_.watch_around(made);
  hidden_.rehouse(made[0]);
}

template <int Dimension>
void DiagramFlips<Dimension>::flip_to_facet(CellId cell, int facet,
                                            int other_vertex) requires(Dimension == 3) {
  // The edge joins the facet's two vertices other than `other_vertex`; d, e and `other_vertex` make the new
  // facet.
  const Beads v = state_.beads_of(cell);
  const BeadId d = v[static_cast<std::size_t>(facet)];
  const BeadId e = state_.apex(cell, facet);
  const BeadId c = v[static_cast<std::size_t>(other_vertex)];
  std::array<int, 2> edge{};
  std::size_t found = 0;
  for (int k = 0; k < 4; ++k) {
    if (k != facet && k != other_vertex) edge[found++] = k;
  }
  const std::array<CellId, 3> old{cell, state_.neighbor(cell, facet), state_.neighbor(cell, other_vertex)};
  std::array<Beads, 3> old_cells{};
  for (std::size_t o = 0; o < 3; ++o) old_cells[o] = state_.beads_of(old[o]);
  if (!can_replace(old_cells, std::array{State::with(v, edge[0], e), State::with(v, edge[1], e)}) ||
      (may_stand_already() && stands_already(std::array{c, d, e}, cell, old[1]))) {
    state_.touch(old);
    state_.suspect_touched(Doubt::wrong);
    return;
  }

  Change change{Events::to_facet, 5, {c, d, e}};
  std::sort(change.ids.begin(), change.ids.begin() + 3);
  const auto [low, high] =
      std::minmax(v[static_cast<std::size_t>(edge[0])], v[static_cast<std::size_t>(edge[1])]);
  change.ids[3] = low;
  change.ids[4] = high;

  hidden_.displace(old);
  facets_.drop_around(old);
  const std::array<CellId, 2> made = state_.triangulation.flip_edge(cell, edge[0], edge[1]);
  state_.record(change);
  facets_.watch_around(made);
  hidden_.rehouse(made[0]);
}

/// 1-4 (1-3): a hidden bead becomes visible and gets cells instead of `cell`, which is its host or an
/// infinite cell beside its host.
template <int Dimension>
void DiagramFlips<Dimension>::show(BeadId bead, CellId cell) {
  const Beads v = state_.beads_of(cell);
  std::array<Beads, Dimension + 1> made_cells{};
  for (int i = 0; i <= Dimension; ++i) made_cells[static_cast<std::size_t>(i)] = State::with(v, i, bead);
  if (!can_replace(std::array<Beads, 1>{v}, made_cells)) return state_.suspect(Doubt::wrong);
  hidden_.drop(bead);
  state_.hidden.show(bead);
  hidden_.displace(std::array{cell});
  facets_.drop_around(std::array{cell});
  const auto made = state_.triangulation.flip_in(cell, bead);
  state_.record(Events::of_hidden(Events::shows, v, bead));
  facets_.watch_around(made);
  hidden_.rehouse(cell);
}

/// 4-1 (3-1): vertex i of `cell`, whose only cells form the star, becomes hidden.
template <int Dimension>
void DiagramFlips<Dimension>::hide(CellId cell, int i) {
  const BeadId bead = state_.vertex(cell, i);
  const auto star = state_.triangulation.star(cell, i);
  const Beads v = State::with(state_.beads_of(cell), i, state_.apex(cell, i == 0 ? 1 : 0));
  std::array<Beads, Dimension + 1> old_cells{};
  for (std::size_t s = 0; s < star.size(); ++s) old_cells[s] = state_.beads_of(star[s]);
  if (bead == infinite_bead || !can_replace(old_cells, std::array<Beads, 1>{v}) ||
      stands_already(v, cell, star[1]))
    return state_.suspect(Doubt::wrong);
  hidden_.displace(star);
  facets_.drop_around(star);
  const CellId made = state_.triangulation.flip_out(cell, i);
  state_.record(Events::of_hidden(Events::hides, v, bead));
  hidden_.hide(bead);
  hidden_.add_displaced(bead);
  facets_.watch_around(std::array{made});
  hidden_.rehouse(made);
}

template <int Dimension>
void DiagramFlips<Dimension>::apply(const Change& change) {
  if (change.size != Dimension + 2) throw std::invalid_argument("a flip has other numbers of beads");
  for (std::size_t i = 0; i < change.size; ++i) {
    if (change.ids[i] >= state_.bead_count() && change.ids[i] != infinite_bead)
      throw std::invalid_argument("there is no bead " + std::to_string(change.ids[i]));
  }
  const auto& id = change.ids;
  if (change.kind == Events::hides || change.kind == Events::shows || change.kind == Events::wanders)
    return apply_to_hidden(change);
  if constexpr (Dimension == 3) {
    if (change.kind == Events::to_facet) return apply_to_facet(change);
  }
  Beads beads{};
  std::copy(id.begin(), id.begin() + Dimension + 1, beads.begin());
  const BeadId d = id[Dimension];
  const BeadId e = id[Dimension + 1];
  const auto cell = state_.triangulation.find_cell(beads);
  if (!cell) throw std::invalid_argument("the diagram has no such cell");
  const int facet = state_.vertex_index(*cell, d);
  if (state_.apex(*cell, facet) != e) throw std::invalid_argument("the facet has another apex");
  if (state_.triangulation.is_edge(d, e)) throw std::invalid_argument("the beads are joined already");
  state_.triangulation.flip_facet(*cell, facet);
}

template <int Dimension>
void DiagramFlips<Dimension>::apply_to_facet(const Change& change) requires(Dimension == 3) {
  const auto& id = change.ids;
  const auto& triangulation = state_.triangulation;
  const auto cell = triangulation.find_cell({id[0], id[1], id[3], id[4]});
  if (!cell || !triangulation.find_cell({id[0], id[2], id[3], id[4]}) ||
      !triangulation.find_cell({id[1], id[2], id[3], id[4]})) {
    throw std::invalid_argument("the edge has other cells");
  }
  if (triangulation.is_facet(id[0], id[1], id[2])) throw std::invalid_argument("the facet stands already");
  state_.triangulation.flip_edge(*cell, state_.vertex_index(*cell, id[3]), state_.vertex_index(*cell, id[4]));
}

/// The hosts of hidden beads are not tracked during a replay.
template <int Dimension>
void DiagramFlips<Dimension>::apply_to_hidden(const Change& change) {
  const BeadId bead = change.kind == Events::wanders ? change.ids[0] : change.ids[Dimension + 1];
  Beads cell{};
  std::copy_n(change.ids.begin() + (change.kind == Events::wanders ? 1 : 0), Dimension + 1, cell.begin());
  if (bead == infinite_bead) throw std::invalid_argument("infinity is never hidden");
  if (state_.hidden.contains(bead) == (change.kind == Events::hides))
    throw std::invalid_argument("bead " + std::to_string(bead) +
                                (change.kind == Events::hides ? " is hidden already" : " is not hidden"));
  const auto stands = state_.triangulation.find_cell(cell);
  if (stands.has_value() == (change.kind == Events::hides))
    throw std::invalid_argument(stands ? "the cell stands already" : "the diagram has no such cell");
  if (change.kind == Events::shows) {
    state_.triangulation.flip_in(*stands, bead);
    state_.hidden.show(bead);
  } else if (change.kind == Events::hides) {
    std::optional<CellId> part;
    for (int i = 0; i <= Dimension; ++i) {
      part = state_.triangulation.find_cell(State::with(cell, i, bead));
      if (!part) throw std::invalid_argument("bead " + std::to_string(bead) + " has other cells");
    }
    state_.triangulation.flip_out(*part, state_.vertex_index(*part, bead));
    state_.hidden.hide(bead);
  }
}

template class DiagramFlips<2>;
template class DiagramFlips<3>;

}  // namespace kds
