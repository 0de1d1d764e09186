#pragma once
// Part of PowerDiagram: beads that come, go and change course while time runs. All signs are taken just after
// the present time, exactly.
//
//   insert   on a walk to where the bead is; the cells whose power spheres hold it are replaced by those that
//            join it to the facets around them (Bowyer-Watson), or it is hidden. Beads in their midst are
//            hidden from then on.
//   erase    the cells around it are replaced by those of the static triangulation of their other beads and
//            of the beads hidden there that fill the same place: all of these are cells of the whole, and
//            hidden beads come back as they are in it.
//   change   the certificates that name the bead are made anew.
//
// Infinite cells take part like any other. Ties for good (whole grids at rest) may leave flat cells, or a
// static triangulation that decided otherwise than the cells that stay: then all is built anew, and counted.

#include <map>
#include <unordered_set>

#include "structures/power_diagram/power_diagram.h"

namespace kds {

namespace detail {

/// The side of a facet on which a cell is: the same for two cells with the facet on the same side. `v` is
/// positively oriented.
template <std::size_t N>
struct FacetSide {
  std::array<BeadId, N - 1> beads{};
  bool even = false;

  FacetSide(const std::array<BeadId, N>& v, std::size_t opposite) {
    for (std::size_t j = 0, k = 0; j < N; ++j) {
      if (j != opposite) beads[k++] = v[j];
    }
    even = (sort_beads(beads) > 0) == ((N - 1 - opposite) % 2 == 0);
  }
  [[nodiscard]] FacetSide beyond() const {
    FacetSide side = *this;
    side.even = !even;
    return side;
  }
  friend auto operator<=>(const FacetSide&, const FacetSide&) = default;
};

/// The beads of a cell ascending, but for the last two where that would turn it over.
template <std::size_t N>
[[nodiscard]] std::array<BeadId, N> in_order(std::array<BeadId, N> cell) {
  if (sort_beads(cell) < 0) std::swap(cell[N - 2], cell[N - 1]);
  return cell;
}

}  // namespace detail

template <Motion M, Kernel K>
void PowerDiagram<M, K>::set_absent(BeadId bead, bool absent) {
  if (is_absent(bead) == absent) return;
  absent_.resize(motion_.bead_count(), 0);
  absent_[bead] = absent ? 1 : 0;
  absent_count_ += absent ? 1 : -1;
}

template <Motion M, Kernel K>
void PowerDiagram<M, K>::require_edit(BeadId bead, bool present) const {
  if (bead >= bead_count()) throw std::invalid_argument("there is no bead " + std::to_string(bead));
  if (is_absent(bead) == present)
    throw std::invalid_argument("bead " + std::to_string(bead) +
                                (present ? " is not in the diagram" : " is in the diagram already"));
}

template <Motion M, Kernel K>
Dyadic PowerDiagram<M, K>::time_of_edit() const {
  if (!within_step_ || !simulator_.now().exact().is_dyadic())
    throw std::invalid_argument("the diagram can be edited only within a step, between events");
  if (affine_dimension_ < dimension) refuse_flat();
  return simulator_.now().exact().lower();
}

template <Motion M, Kernel K>
void PowerDiagram<M, K>::leave_out(BeadId bead) {
  require_edit(bead, true);
  if (!triangulation_.cells().empty())
    throw std::invalid_argument("beads are left out before the diagram is built");
  set_absent(bead, true);
}

template <Motion M, Kernel K>
void PowerDiagram<M, K>::insert(BeadId bead, BeadId near) {
  require_edit(bead, false);
  if (near != no_bead) require_edit(near, true);
  static_cast<void>(time_of_edit());
  const CellId from = cell_near(near);
  set_absent(bead, false);
  put_in(bead, from);
}

template <Motion M, Kernel K>
void PowerDiagram<M, K>::erase(BeadId bead) {
  require_edit(bead, true);
  const Dyadic time = time_of_edit();
  if (bead_count() - absent_count_ <= dimension + 1)
    throw std::invalid_argument("the power diagram needs at least " + std::to_string(dimension + 1) +
                                " beads");
  if (hidden_.contains(bead)) return take_out_hidden(bead);
  const std::vector<CellId> around = triangulation_.cells_around(bead);
  displace(around);
  take_out(bead, around, time);
}

template <Motion M, Kernel K>
template <std::invocable SetCurve>
void PowerDiagram<M, K>::change_motion(BeadId bead, SetCurve set_curve) {
  require_edit(bead, true);
  const Dyadic time = time_of_edit();
  present_ = {};
  const bool hidden = hidden_.contains(bead);
  std::vector<CellId> around;
  if (hidden) {
    drop_hidden(bead);
  } else {
    around = triangulation_.cells_around(bead);
  }
  displace(around);
  drop_around(around);
  const auto before = exact_position(motion_, bead, time);
  set_curve();
  if (exact_position(motion_, bead, time) != before) {
    simulator_.record(index_, {changes, 1, {bead}});
    BeadId near = no_bead;
    if (hidden) {
      take_out_hidden(bead);
    } else {
      const Beads& v = triangulation_.cells()[around[0]].vertex;
      near = *std::find_if(v.begin(), v.end(), [&](BeadId b) { return b != bead && b != infinite_bead; });
      take_out(bead, around, time);
    }
    const CellId from = cell_near(near);
    set_absent(bead, false);
    return put_in(bead, from);
  }
  if (hidden) {
    enqueue_hidden(bead);
    watch_enqueued();
  } else {
    watch_around(around);
    rehouse(around[0]);
  }
  finish_edit(changes, bead);
}

template <Motion M, Kernel K>
CellId PowerDiagram<M, K>::cell_near(BeadId near) const {
  if (near != no_bead && !hidden_.contains(near)) return triangulation_.cells_around(near)[0];
  const CellId host = near == no_bead ? no_cell : hidden_.host(near);
  return host == no_cell ? some_finite_cell() : host;
}

template <Motion M, Kernel K>
int PowerDiagram<M, K>::power_against(BeadId bead, CellId cell) {
  return with_facet_certificate(triangulation_.cells()[cell].vertex, bead,
                                [this](const auto& certificate) { return sign_after_edit(certificate); });
}

template <Motion M, Kernel K>
void PowerDiagram<M, K>::put_in(BeadId bead, CellId from) {
  present_ = {};
  const CellId cell = walk_to(bead, from);
  if (cell == no_cell) return rebuild_after_edit(inserts, bead);
  if (!is_infinite(cell) && power_against(bead, cell) >= 0) {
    hidden_.hide(bead);
    hidden_guards_.resize(motion_.bead_count(), no_guards);
    hidden_.enter(bead, cell);
    enqueue_hidden(bead);
    watch_enqueued();
    return finish_edit(inserts, bead);
  }
  for (const bool zero_too : {false, true}) {
    const std::vector<CellId> hole = cells_in_conflict(bead, cell, zero_too);
    const std::vector<Beads> made = star_in_place_of(hole, bead);
    if (!can_fill(hole, made)) continue;
    displace(hole);
    fill(hole, made);
    return finish_edit(inserts, bead);
  }
  rebuild_after_edit(inserts, bead);
}

template <Motion M, Kernel K>
void PowerDiagram<M, K>::take_out_hidden(BeadId bead) {
  drop_hidden(bead);
  hidden_.show(bead);
  set_absent(bead, true);
  finish_edit(erases, bead);
}

/// With the cells around it, whose hidden beads are displaced.
template <Motion M, Kernel K>
void PowerDiagram<M, K>::take_out(BeadId bead, std::span<const CellId> hole, const Dyadic& time) {
  present_ = {};
  set_absent(bead, true);
  std::vector<BeadId> beads = displaced_;
  for (const CellId cell : hole) {
    const Beads& v = triangulation_.cells()[cell].vertex;
    std::copy_if(v.begin(), v.end(), std::back_inserter(beads),
                 [bead](BeadId b) { return b != bead && b != infinite_bead; });
  }
  std::vector<Beads> made = fill_of(hole, bead, beads, time);
  if (made.empty()) {  // these may lie in one plane: the beads beyond do not
    for (const CellId cell : hole) {
      if (const BeadId b = apex(cell, place_of(cell, bead)); b != infinite_bead) beads.push_back(b);
    }
    made = fill_of(hole, bead, beads, time);
  }
  if (!can_fill(hole, made)) return rebuild_after_edit(erases, bead);
  fill(hole, made);
  finish_edit(erases, bead);
}

/// The connected cells that the bead is in conflict with, among them `start`.
template <Motion M, Kernel K>
std::vector<CellId> PowerDiagram<M, K>::cells_in_conflict(BeadId bead, CellId start, bool zero_too) {
  std::vector<CellId> found{start};
  std::unordered_set<CellId> looked_at{start};
  for (std::size_t next = 0; next < found.size(); ++next) {
    for (int i = 0; i <= dimension; ++i) {
      const CellId beside = neighbor(found[next], i);
      if (!looked_at.insert(beside).second) continue;
      const int sign = power_against(bead, beside);
      if (sign < 0 || (zero_too && sign == 0)) found.push_back(beside);
    }
  }
  return found;
}

template <Motion M, Kernel K>
auto PowerDiagram<M, K>::star_in_place_of(std::span<const CellId> hole, BeadId bead) const
    -> std::vector<Beads> {
  const std::unordered_set<CellId> inside(hole.begin(), hole.end());
  std::vector<Beads> made;
  for (const CellId cell : hole) {
    for (int i = 0; i <= dimension; ++i) {
      if (!inside.contains(neighbor(cell, i)))
        made.push_back(with(triangulation_.cells()[cell].vertex, i, bead));
    }
  }
  return made;
}

/// Cells for the place of those around a bead, of the static triangulation of some others, among them all
/// around it; none if it does not have the facets around.
template <Motion M, Kernel K>
auto PowerDiagram<M, K>::fill_of(std::span<const CellId> hole, BeadId bead, std::vector<BeadId> beads,
                                 const Dyadic& time) const -> std::vector<Beads> {
  using Side = detail::FacetSide<dimension + 1>;
  std::sort(beads.begin(), beads.end());
  beads.erase(std::unique(beads.begin(), beads.end()), beads.end());
  const auto built = exact_static(beads, time, true);
  std::map<Side, std::size_t> cell_on;
  for (std::size_t c = 0; c < built.cells.size(); ++c) {
    for (std::size_t i = 0; i <= dimension; ++i) cell_on.emplace(Side(built.cells[c], i), c);
  }
  std::vector<Side> open;
  for (const CellId cell : hole)
    open.emplace_back(triangulation_.cells()[cell].vertex, static_cast<std::size_t>(place_of(cell, bead)));
  std::vector<Side> around = open;
  std::sort(around.begin(), around.end());
  std::vector<char> taken(built.cells.size(), 0);
  std::vector<Beads> made;
  while (!open.empty()) {
    const auto cell = cell_on.find(open.back());
    open.pop_back();
    if (cell == cell_on.end()) return {};
    const Beads& v = built.cells[cell->second];
    if (std::exchange(taken[cell->second], 1) != 0) continue;
    made.push_back(v);
    for (std::size_t i = 0; i <= dimension; ++i) {
      const Side side(v, i);
      if (!std::binary_search(around.begin(), around.end(), side)) open.push_back(side.beyond());
    }
  }
  return made;
}

template <Motion M, Kernel K>
bool PowerDiagram<M, K>::can_fill(std::span<const CellId> hole, std::span<const Beads> made) {
  return triangulation_.fits(hole, made) && std::all_of(made.begin(), made.end(), [this](const Beads& cell) {
           const Orientation<dimension> orientation(cell, 1);
           return orientation.beads.back() == infinite_bead || sign_after_edit(orientation) > 0;
         });
}

template <Motion M, Kernel K>
void PowerDiagram<M, K>::drop_around(std::span<const CellId> cells) {
  for (const CellId cell : cells) {
    for (int i = 0; i <= dimension; ++i) drop(cell, i);  // the second drop of an inner facet finds it gone
  }
}

/// Exchanges cells whose hidden beads are displaced, and guards the new ones.
template <Motion M, Kernel K>
void PowerDiagram<M, K>::fill(std::span<const CellId> hole, std::span<const Beads> made) {
  drop_around(hole);
  std::vector<Beads> cleared, filled;
  for (const CellId cell : hole) {
    cleared.push_back(triangulation_.cells()[cell].vertex);
    std::sort(cleared.back().begin(), cleared.back().end());
  }
  for (const Beads& cell : made) filled.push_back(detail::in_order(cell));
  for (auto* cells : {&cleared, &filled}) {
    std::sort(cells->begin(), cells->end());
    for (const Beads& cell : *cells) {
      Change change{cells == &cleared ? clears : fills, dimension + 1, {}};
      std::copy(cell.begin(), cell.end(), change.ids.begin());
      simulator_.record(index_, change);
    }
  }
  const std::size_t hidden = hidden_.size();
  const std::vector<CellId> cells = exchange_cells(hole, filled);
  if (hidden_.size() != hidden) hidden_guards_.resize(motion_.bead_count(), no_guards);
  watch_around(cells);
  rehouse(cells[0]);
}

/// Beads that have no cell any more are hidden, and displaced; hidden ones that have cells come back.
template <Motion M, Kernel K>
std::vector<CellId> PowerDiagram<M, K>::exchange_cells(std::span<const CellId> hole,
                                                       std::span<const Beads> made) {
  std::vector<BeadId> before;
  for (const CellId cell : hole) {
    const Beads& v = triangulation_.cells()[cell].vertex;
    before.insert(before.end(), v.begin(), v.end());
  }
  std::sort(before.begin(), before.end());
  before.erase(std::unique(before.begin(), before.end()), before.end());
  std::vector<CellId> cells = triangulation_.replace(hole, made);
  for (const BeadId b : before) {
    if (is_absent(b) || triangulation_.is_vertex(b)) continue;
    hidden_.hide(b);
    displaced_.push_back(b);
  }
  for (const Beads& cell : made) {
    for (const BeadId b : cell) {
      if (b == infinite_bead || !hidden_.contains(b)) continue;
      hidden_.show(b);
      std::erase(displaced_, b);
    }
  }
  std::sort(displaced_.begin(), displaced_.end());
  return cells;
}

template <Motion M, Kernel K>
void PowerDiagram<M, K>::finish_edit(Kind kind, BeadId bead) {
  simulator_.record(index_, {kind, 1, {bead}});
  if (!needs_after_batch) return;
  needs_after_batch = false;
  after_batch();
}

template <Motion M, Kernel K>
void PowerDiagram<M, K>::rebuild_after_edit(Kind kind, BeadId bead) {
  simulator_.record(index_, {kind, 1, {bead}});
  needs_after_batch = false;
  rebuild_at_first_time_that_works();
}

/// No cells before it: the bead is hidden, or a rebuild follows.
template <Motion M, Kernel K>
void PowerDiagram<M, K>::apply_edit(const Change& change) {
  const auto& id = change.ids;
  if (change.kind > changes || change.size != (change.kind <= fills ? dimension + 1 : 1))
    throw std::invalid_argument("an edit has other numbers of beads");
  for (std::size_t i = 0; i < change.size; ++i) {
    if (id[i] >= bead_count() && (change.kind > fills || id[i] != infinite_bead))
      throw std::invalid_argument("there is no bead " + std::to_string(id[i]));
  }
  if (change.kind <= fills) {
    Beads cell{};
    std::copy_n(id.begin(), dimension + 1, cell.begin());
    if (change.kind == fills) return filled_.push_back(cell);
    const auto stands = triangulation_.find_cell(cell);
    if (!stands) throw std::invalid_argument("the diagram has no such cell");
    return cleared_.push_back(*stands);
  }
  const BeadId bead = id[0];
  require_edit(bead, change.kind != inserts);
  const std::vector<CellId> hole = std::exchange(cleared_, {});
  const std::vector<Beads> made = std::exchange(filled_, {});
  if (change.kind == changes) {
    if (!hole.empty() || !made.empty()) throw std::invalid_argument("a change of motion changes no cells");
    return;
  }
  if (!(hole.empty() && made.empty()) && !triangulation_.fits(hole, made))
    throw std::invalid_argument("the cells do not fill the place of those cleared");
  set_absent(bead, change.kind == erases);
  if (!hole.empty()) {
    displaced_.clear();
    static_cast<void>(exchange_cells(hole, made));
  } else if (change.kind == inserts) {
    hidden_.hide(bead);
  } else if (hidden_.contains(bead)) {
    hidden_.show(bead);
  }
}

}  // namespace kds
