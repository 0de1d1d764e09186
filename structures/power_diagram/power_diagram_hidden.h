#pragma once
// Part of PowerDiagram: hidden beads. Each is guarded against its host cell: a power test (when it fails the
// bead comes back, 1-4), and an orientation for each facet (when one fails the bead wanders to the cell
// beyond, or comes back there if that is an infinite one).

#include "structures/power_diagram/power_diagram.h"

namespace kds {

template <Motion M, Kernel K>
void PowerDiagram<M, K>::fail_hidden(unsigned table, std::uint32_t slot) {
  if (table == appearing) {
    const BeadId bead = appearances_.place_in_structure(slot);
    hidden_guards_[bead].back() = CertificateHandle::violated;
    if (doubt_ == Doubt::wrong) return;
    begin_event(appearances_.identity(slot));
    show(bead, hidden_.host(bead));
  } else {
    const FacetId place = departures_.place_in_structure(slot);
    const BeadId bead = cell_of(place);
    const int facet = index_of(place);
    hidden_guards_[bead][static_cast<std::size_t>(facet)] = CertificateHandle::violated;
    if (doubt_ == Doubt::wrong) return;
    begin_event(departures_.identity(slot));
    if (const CellId beyond = neighbor(hidden_.host(bead), facet); is_infinite(beyond)) {
      show(bead, beyond);
    } else {
      wander(bead, facet);
    }
  }
  present_ = {};
}

template <Motion M, Kernel K>
void PowerDiagram<M, K>::wander(BeadId bead, int facet) {
  const auto [beyond, came_from] = across(hidden_.host(bead), facet);
  drop_hidden(bead);
  const CellId host = find_host(bead, beyond, came_from);
  if (host == no_cell) return suspect(Doubt::wrong);
  hidden_.enter(bead, host);
  Change change{wanders, dimension + 2, {bead}};
  const Beads& v = triangulation_.cells()[host].vertex;
  std::copy(v.begin(), v.end(), change.ids.begin() + 1);
  std::sort(change.ids.begin() + 1, change.ids.begin() + dimension + 2);
  simulator_.record(index_, change);
  enqueue_hidden(bead);
  watch_enqueued();
}

/// The cell in which a bead is just after now, an infinite one where it is outside the hull, on a walk from
/// some cell, on which it came through a facet; no_cell where signs contradict each other.
template <Motion M, Kernel K>
CellId PowerDiagram<M, K>::walk_to(BeadId bead, CellId cell, int came_from) {
  if (is_infinite(cell)) {
    cell = neighbor(cell, place_of(cell, infinite_bead));
    came_from = -1;
  }
  const std::size_t most_steps = triangulation_.cells().size();
  for (std::size_t step = 0; step <= most_steps; ++step) {
    if (is_infinite(cell)) return cell;
    const Beads& v = triangulation_.cells()[cell].vertex;
    int leaves_by = -1;
    for (int i = 0; i <= dimension && leaves_by < 0; ++i) {
      if (i != came_from && sign_just_after<K>(Orientation<dimension>(with(v, i, bead), 1), motion_,
                                               simulator_.now(), statistics.stages) < 0)
        leaves_by = i;
    }
    if (leaves_by < 0) return cell;
    std::tie(cell, came_from) = across(cell, leaves_by);
  }
  return no_cell;
}

/// The host of a bead just after now; no_cell where none is found.
template <Motion M, Kernel K>
CellId PowerDiagram<M, K>::find_host(BeadId bead, CellId cell, int came_from) {
  const CellId at = walk_to(bead, cell, came_from);
  return at == no_cell || is_infinite(at) ? no_cell : at;
}

template <Motion M, Kernel K>
void PowerDiagram<M, K>::enqueue_hidden(BeadId bead) {
  const Beads& v = triangulation_.cells()[hidden_.host(bead)].vertex;
  for (int i = 0; i <= dimension; ++i) {
    const Orientation<dimension> inside(with(v, i, bead), 1);
    departures_.enqueue_one_of_many(inside, facet_id(bead, i), birth_of(inside));
  }
  std::array<BeadId, dimension + 2> beads{};
  std::copy(v.begin(), v.end(), beads.begin());
  beads.back() = bead;
  const PowerTest<dimension> above(beads, 1);
  appearances_.enqueue_one_of_many(above, bead, birth_of(above));
}

template <Motion M, Kernel K>
void PowerDiagram<M, K>::drop_hidden(BeadId bead) {
  for (std::size_t i = 0; i <= dimension; ++i) give_up(departures_, hidden_guards_[bead][i]);
  give_up(appearances_, hidden_guards_[bead].back());
  hidden_guards_[bead] = no_guards;
}

/// Hosts all hidden beads anew where they are in no cell, or not in theirs any more, and guards them.
template <Motion M, Kernel K>
void PowerDiagram<M, K>::watch_all_hidden() {
  hidden_guards_.assign(hidden_.empty() ? 0 : motion_.bead_count(), no_guards);
  displaced_.clear();
  if (hidden_.empty()) return;
  for (const BeadId bead : hidden_.beads()) {
    if (hidden_.host(bead) == no_cell) {
      displaced_.push_back(bead);
    } else {
      enqueue_hidden(bead);
    }
  }
  const auto take = [this](BeadId bead, int i, CertificateHandle guard) {
    hidden_guards_[bead][static_cast<std::size_t>(i)] = guard;
    if (guard == CertificateHandle::violated) displaced_.push_back(bead);
  };
  departures_.watch_enqueued(
      [&](FacetId place, CertificateHandle guard) { take(cell_of(place), index_of(place), guard); });
  appearances_.watch_enqueued(
      [&](BeadId bead, CertificateHandle guard) { take(bead, dimension + 1, guard); });
  std::sort(displaced_.begin(), displaced_.end());
  displaced_.erase(std::unique(displaced_.begin(), displaced_.end()), displaced_.end());
  for (const BeadId bead : displaced_) drop_hidden(bead);
  rehouse(some_finite_cell());
}

/// The hidden beads of cells that will go are without host and guards until they are housed again.
template <Motion M, Kernel K>
void PowerDiagram<M, K>::displace(std::span<const CellId> cells) {
  displaced_.clear();
  if (hidden_.empty()) return;
  for (const CellId cell : cells) hidden_.empty_out(cell, displaced_);
  for (const BeadId bead : displaced_) drop_hidden(bead);
  std::sort(displaced_.begin(), displaced_.end());
}

template <Motion M, Kernel K>
void PowerDiagram<M, K>::rehouse(CellId near) {
  if (displaced_.empty()) return;
  for (const BeadId bead : displaced_) {
    const CellId from = hidden_.host(bead) == no_cell ? near : hidden_.host(bead);
    const CellId host = find_host(bead, from);
    if (host == no_cell) {
      suspect(Doubt::wrong);
      continue;
    }
    hidden_.enter(bead, host);
    enqueue_hidden(bead);
  }
  displaced_.clear();
  watch_enqueued();
}

template <Motion M, Kernel K>
CellId PowerDiagram<M, K>::some_finite_cell() const {
  CellId cell = 0;
  while (!triangulation_.is_live(cell) || is_infinite(cell)) ++cell;
  return cell;
}

/// 1-4 (1-3): a hidden bead gets cells in the place of one, its host or an infinite one beside it.
template <Motion M, Kernel K>
void PowerDiagram<M, K>::show(BeadId bead, CellId cell) {
  const Beads v = triangulation_.cells()[cell].vertex;
  std::array<Beads, dimension + 1> made_cells{};
  for (int i = 0; i <= dimension; ++i) made_cells[static_cast<std::size_t>(i)] = with(v, i, bead);
  if (!can_replace(std::array<Beads, 1>{v}, made_cells)) return suspect(Doubt::wrong);
  drop_hidden(bead);
  hidden_.show(bead);
  displace(std::array{cell});
  for (int i = 0; i <= dimension; ++i) drop(cell, i);
  const auto made = triangulation_.flip_in(cell, bead);
  simulator_.record(index_, change_of(shows, v, bead));
  watch_around(made);
  rehouse(cell);
}

/// 4-1 (3-1): vertex i of `cell`, with no cells but those of a star, is hidden.
template <Motion M, Kernel K>
void PowerDiagram<M, K>::hide(CellId cell, int i) {
  const BeadId bead = vertex(cell, i);
  const auto star = triangulation_.star(cell, i);
  const Beads v = with(triangulation_.cells()[cell].vertex, i, apex(cell, i == 0 ? 1 : 0));
  std::array<Beads, dimension + 1> old_cells{};
  for (std::size_t s = 0; s < star.size(); ++s) old_cells[s] = triangulation_.cells()[star[s]].vertex;
  if (bead == infinite_bead || !can_replace(old_cells, std::array<Beads, 1>{v}) ||
      stands_already(v, cell, star[1]))
    return suspect(Doubt::wrong);
  displace(star);
  for (const CellId s : star) {
    for (int k = 0; k <= dimension; ++k) drop(s, k);  // the second drop of an inner facet finds it gone
  }
  const CellId made = triangulation_.flip_out(cell, i);
  simulator_.record(index_, change_of(hides, v, bead));
  hidden_.hide(bead);
  hidden_guards_.resize(motion_.bead_count(), no_guards);
  displaced_.push_back(bead);
  std::sort(displaced_.begin(), displaced_.end());
  watch_around(std::array{made});
  rehouse(made);
}

}  // namespace kds
