#include "structures/power_diagram/diagram_editor.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <unordered_set>
#include <utility>

#include "certificates/exact/exact_time.h"
#include "motions/curves/positions.h"
#include "structures/power_diagram/diagram_state.h"

namespace kds {

namespace {

constexpr unsigned finest_grid = 200;  // binary digits of times at which edits look

}  // namespace

template <int Dimension>
void DiagramEditor<Dimension>::require_time() const {
  state_.simulator.require_standing_still();
  require_cells();
}

template <int Dimension>
void DiagramEditor<Dimension>::require_cells() const {
  if (!state_.within_step)
    throw std::invalid_argument("the diagram can be edited only in a step in which all beads move");
  if (!state_.has_cells())
    throw std::invalid_argument("the diagram cannot be edited in a step in which all beads stay " +
                                std::string(in_what));
}

template <int Dimension>
void DiagramEditor<Dimension>::require_release(std::span<const BeadId> beads) const {
  if (std::any_of(beads.begin(), beads.end(), [this](BeadId b) { return !state_.is_absent(b); }))
    require_cells();
}

/// Returns whether all beads except `bead` stay in one plane (on one line). A cell without `bead` whose beads
/// span space shows that they do not; nearly always the first such cell suffices.
template <int Dimension>
bool DiagramEditor<Dimension>::is_flat_without(BeadId bead) const {
  if (state_.present_beads.count() <= Dimension + 1) return true;
  constexpr int most_cells = 8;
  int looked_at = 0;
  for (CellId cell = 0; cell < state_.triangulation.cells().size() && looked_at < most_cells; ++cell) {
    if (!state_.triangulation.is_live(cell) || state_.is_infinite(cell) ||
        state_.vertex_index(cell, bead) <= Dimension)
      continue;
    Beads beads = state_.beads_of(cell);
    std::sort(beads.begin(), beads.end());
    if (!stays_flat(beads)) return false;
    ++looked_at;
  }
  std::vector<BeadId> others = state_.present_beads.all();
  std::erase(others, bead);
  return stays_flat(others);
}

/// Returns whether the beads lie in one plane (on one line) at all times. It suffices to test more times than
/// a function of these beads has roots, unless that function is zero throughout.
template <int Dimension>
bool DiagramEditor<Dimension>::stays_flat(std::span<const BeadId> beads) const {
  for (int times = 0; times <= Dimension * state_.motion.degree(); ++times) {
    const Dyadic time(Integer(2 * times + 1), 7);
    if (static_diagram(state_, beads, time, false).dimension == Dimension) return false;
  }
  return true;
}

template <int Dimension>
std::optional<Dyadic> DiagramEditor<Dimension>::rational_now() const {
  // One kernel may know a time as a dyadic number, the other as a root. If the time is on the grid,
  // next_on_grid makes it a number.
  ExactTime& now = state_.simulator.now().exact();
  static_cast<void>(next_on_grid(now, finest_grid));
  return now.is_dyadic() ? std::optional(now.lower()) : std::nullopt;
}

template <int Dimension>
void DiagramEditor<Dimension>::insert(BeadId bead, BeadId near) {
  state_.present_beads.require(bead, true);
  if (near != no_bead) state_.present_beads.require(near, false);
  require_time();
  const CellId from = cell_near(near);
  state_.present_beads.set_absent(bead, false);
  put_in(bead, from);
}

template <int Dimension>
void DiagramEditor<Dimension>::erase(BeadId bead) {
  state_.present_beads.require(bead, false);
  require_time();
  if (state_.present_beads.count() <= Dimension + 1)
    throw std::invalid_argument("the power diagram needs at least " + std::to_string(Dimension + 1) +
                                " beads");
  if (state_.hidden.contains(bead)) return take_out_hidden(bead);
  if (is_flat_without(bead))
    throw std::invalid_argument("without bead " + std::to_string(bead) + " all beads stay " + in_what +
                                ": no power diagram is left");
  const std::vector<CellId> around = state_.triangulation.cells_around(bead);
  hidden_.displace(around);
  take_out(bead, around);
}

template <int Dimension>
auto DiagramEditor<Dimension>::positions_of_released(const Dyadic& time) const -> std::vector<ExactPosition> {
  std::vector<ExactPosition> positions;
  state_.motion.visit([&](const auto& curves) {
    for (const BeadId bead : released_) positions.push_back(exact_position(curves, bead, time));
  });
  return positions;
}

template <int Dimension>
std::vector<double> DiagramEditor<Dimension>::numbers_of_released() const {
  const Curves<Dimension> curves = state_.motion.curves();
  std::vector<double> numbers;
  for (const BeadId bead : released_)
    for (int k = 0; k <= curves.own_degree(); ++k)
      numbers.insert(numbers.end(), curves.control_point(bead, k),
                     curves.control_point(bead, k) + Dimension + 1);
  return numbers;
}

template <int Dimension>
void DiagramEditor<Dimension>::release(std::span<const BeadId> beads) {
  released_.clear();
  before_.clear();
  around_.clear();
  std::copy_if(beads.begin(), beads.end(), std::back_inserter(released_),
               [this](BeadId bead) { return !state_.is_absent(bead); });
  std::sort(released_.begin(), released_.end());
  if (released_.empty()) return;
  facets_.forget_courses();
  numbers_before_ = numbers_of_released();
  if (const auto time = rational_now()) before_ = positions_of_released(*time);
  state_.present = {};
  if (released_.size() > 1) {
    facets_.drop_all();
    return hidden_.drop_all();
  }
  if (state_.hidden.contains(released_[0])) return hidden_.drop(released_[0]);
  around_ = state_.triangulation.cells_around(released_[0]);
  hidden_.displace(around_);
  facets_.drop_around(around_);
}

template <int Dimension>
void DiagramEditor<Dimension>::take_up() {
  state_.curves = state_.motion.curves();
  if (released_.empty()) return;
  for (const BeadId bead : released_) state_.record({Events::changes, 1, {bead}});
  const auto time = rational_now();
  const bool jump =
      numbers_of_released() != numbers_before_ && (!time || positions_of_released(*time) != before_);
  if (released_.size() > 1) {
    if (jump) return rebuilder_.rebuild_at_first_time_that_works();
    rebuilder_.watch_all();
  } else if (jump) {
    return move_elsewhere(released_[0]);
  } else if (around_.empty()) {
    hidden_.watch(released_[0]);
  } else {
    facets_.watch_around(around_);
    hidden_.rehouse(around_[0]);
  }
  settle();
}

template <int Dimension>
void DiagramEditor<Dimension>::move_elsewhere(BeadId bead) {
  BeadId near = no_bead;
  if (around_.empty()) {
    take_out_hidden(bead);
  } else if (is_flat_without(bead)) {
    facets_.drop_all();
    hidden_.drop_all();
    return rebuilder_.rebuild_at_first_time_that_works();
  } else {
    const Beads& v = state_.beads_of(around_[0]);
    near = *std::find_if(v.begin(), v.end(), [&](BeadId b) { return b != bead && b != infinite_bead; });
    take_out(bead, around_);
  }
  const CellId from = cell_near(near);
  state_.present_beads.set_absent(bead, false);
  put_in(bead, from);
}

template <int Dimension>
CellId DiagramEditor<Dimension>::cell_near(BeadId near) const {
  if (near != no_bead && !state_.hidden.contains(near)) return state_.triangulation.cells_around(near)[0];
  const CellId host = near == no_bead ? no_cell : state_.hidden.host(near);
  return host == no_cell ? state_.some_finite_cell() : host;
}

template <int Dimension>
int DiagramEditor<Dimension>::power_against(BeadId bead, CellId cell) {
  return with_facet_certificate(state_.beads_of(cell), bead, [this](const auto& certificate) {
    return state_.sign_just_after(certificate);
  });
}

template <int Dimension>
void DiagramEditor<Dimension>::put_in(BeadId bead, CellId from) {
  state_.present = {};
  const CellId cell = hidden_.walk_to(bead, from);
  if (cell == no_cell) return rebuild_after_edit(Events::inserts, bead);
  if (!state_.is_infinite(cell) && power_against(bead, cell) >= 0) {
    hidden_.hide(bead);
    hidden_.enter(bead, cell);
    return finish_edit(Events::inserts, bead);
  }
  for (const bool zero_too : {false, true}) {
    const std::vector<CellId> hole = cells_in_conflict(bead, cell, zero_too);
    const std::vector<Beads> made = star_in_place_of(hole, bead);
    if (!exchange_.can_fill(hole, made)) continue;
    hidden_.displace(hole);
    exchange_.fill(hole, made);
    return finish_edit(Events::inserts, bead);
  }
  rebuild_after_edit(Events::inserts, bead);
}

template <int Dimension>
void DiagramEditor<Dimension>::take_out_hidden(BeadId bead) {
  hidden_.drop(bead);
  state_.hidden.show(bead);
  state_.present_beads.set_absent(bead, true);
  finish_edit(Events::erases, bead);
}

template <int Dimension>
auto DiagramEditor<Dimension>::fill_without(BeadId bead, std::span<const CellId> hole,
                                            const Dyadic& time) const -> std::vector<Beads> {
  std::vector<BeadId> beads(hidden_.displaced().begin(), hidden_.displaced().end());
  for (const CellId cell : hole) {
    const Beads& v = state_.beads_of(cell);
    std::copy_if(v.begin(), v.end(), std::back_inserter(beads),
                 [bead](BeadId b) { return b != bead && b != infinite_bead; });
  }
  std::vector<Beads> made = exchange_.fill_of(hole, beads, time);
  if (!made.empty()) return made;
  // The beads of the hole may lie in one plane; together with the beads beyond they do not.
  for (const CellId cell : hole) {
    if (const BeadId b = state_.apex(cell, state_.vertex_index(cell, bead)); b != infinite_bead)
      beads.push_back(b);
  }
  return exchange_.fill_of(hole, beads, time);
}

template <int Dimension>
void DiagramEditor<Dimension>::take_out(BeadId bead, std::span<const CellId> hole) {
  state_.present = {};
  state_.present_beads.set_absent(bead, true);
  const auto try_at = [&](const Dyadic& time, bool soon_after) {
    const std::vector<Beads> made = fill_without(bead, hole, time);
    if (!exchange_.can_fill(hole, made) || (soon_after && !exchange_.is_regular(hole, made))) return false;
    exchange_.fill(hole, made);
    finish_edit(Events::erases, bead);
    return true;
  };
  if (const auto now = rational_now()) {
    if (try_at(*now, false)) return;
  } else {
    for (const unsigned bits : {80U, finest_grid}) {  // an event before these times is very unlikely
      const Dyadic time = next_on_grid(state_.simulator.now().exact(), bits);
      if (time < Dyadic(1.0) && try_at(time, true)) return;
    }
  }
  rebuild_after_edit(Events::erases, bead);
}

/// Returns the connected cells that are in conflict with the bead, starting with `start`.
template <int Dimension>
std::vector<CellId> DiagramEditor<Dimension>::cells_in_conflict(BeadId bead, CellId start, bool zero_too) {
  std::vector<CellId> found{start};
  std::unordered_set<CellId> looked_at{start};
  for (std::size_t next = 0; next < found.size(); ++next) {
    for (int i = 0; i <= Dimension; ++i) {
      const CellId beside = state_.neighbor(found[next], i);
      if (!looked_at.insert(beside).second) continue;
      const int sign = power_against(bead, beside);
      if (sign < 0 || (zero_too && sign == 0)) found.push_back(beside);
    }
  }
  return found;
}

template <int Dimension>
auto DiagramEditor<Dimension>::star_in_place_of(std::span<const CellId> hole, BeadId bead) const
    -> std::vector<Beads> {
  const std::unordered_set<CellId> inside(hole.begin(), hole.end());
  std::vector<Beads> made;
  for (const CellId cell : hole) {
    for (int i = 0; i <= Dimension; ++i) {
      if (!inside.contains(state_.neighbor(cell, i)))
        made.push_back(State::with(state_.beads_of(cell), i, bead));
    }
  }
  return made;
}

template <int Dimension>
void DiagramEditor<Dimension>::finish_edit(Kind kind, BeadId bead) {
  state_.record({kind, 1, {bead}});
  settle();
}

/// Raises a doubt about the touched cells if a certificate vanishes now: in this case new cells or courses
/// may turn cells over, or wind the hull around twice, without an event.
template <int Dimension>
void DiagramEditor<Dimension>::settle() {
  if (!state_.is_generic_now()) state_.suspect_touched(Doubt::unclear);
  if (!state_.owner.needs_after_batch) return;
  state_.owner.needs_after_batch = false;
  rebuilder_.after_batch();
}

template <int Dimension>
void DiagramEditor<Dimension>::rebuild_after_edit(Kind kind, BeadId bead) {
  state_.record({kind, 1, {bead}});
  state_.owner.needs_after_batch = false;
  rebuilder_.rebuild_at_first_time_that_works();
}

template <int Dimension>
void DiagramEditor<Dimension>::apply(const Change& change) {
  const auto& id = change.ids;
  if (change.kind > Events::repairs || change.size != (change.kind <= Events::fills ? Dimension + 1 : 1))
    throw std::invalid_argument("an edit has other numbers of beads");
  for (std::size_t i = 0; i < change.size; ++i) {
    if (id[i] >= state_.bead_count() && (change.kind > Events::fills || id[i] != infinite_bead))
      throw std::invalid_argument("there is no bead " + std::to_string(id[i]));
  }
  if (change.kind <= Events::fills) {
    Beads cell{};
    std::copy_n(id.begin(), Dimension + 1, cell.begin());
    if (change.kind == Events::fills) return filled_.push_back(cell);
    const auto stands = state_.triangulation.find_cell(cell);
    if (!stands) throw std::invalid_argument("the diagram has no such cell");
    return cleared_.push_back(*stands);
  }
  const BeadId bead = id[0];
  const bool repair = change.kind == Events::repairs;
  state_.present_beads.require(bead, change.kind == Events::inserts);
  const std::vector<CellId> hole = std::exchange(cleared_, {});
  const std::vector<Beads> made = std::exchange(filled_, {});
  if (change.kind == Events::changes) {
    if (!hole.empty() || !made.empty()) throw std::invalid_argument("a change of motion changes no cells");
    return;
  }
  if (repair && made.empty()) throw std::invalid_argument("a repair exchanges cells");
  const bool all = repair && hole.size() == state_.triangulation.live_count();
  const bool fit =
      all ? RegularTriangulation<Dimension>().fits({}, made) : state_.triangulation.fits(hole, made);
  if (!(hole.empty() && made.empty()) && !fit)
    throw std::invalid_argument("the new cells do not fill the hole");
  if (!repair) state_.present_beads.set_absent(bead, change.kind == Events::erases);
  if (all) {
    rebuilder_.assign_logged(made);
  } else if (!hole.empty()) {
    hidden_.forget_displaced();
    static_cast<void>(exchange_.exchange(hole, made));
  } else if (change.kind == Events::inserts) {
    state_.hidden.hide(bead);
  } else if (state_.hidden.contains(bead)) {
    state_.hidden.show(bead);
  }
}

template class DiagramEditor<2>;
template class DiagramEditor<3>;

}  // namespace kds
