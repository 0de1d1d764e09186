#include "structures/power_diagram/diagram_rebuilder.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "certificates/exact/exact_time.h"
#include "motions/base/input_error.h"
#include "motions/curves/positions.h"
#include "structures/power_diagram/diagram_checks.h"
#include "structures/power_diagram/diagram_state.h"

namespace kds {

namespace {

constexpr std::size_t most_times = 64;  // limit, because further times are much like these

/// Returns the cells together with the ring of cells around them.
template <int Dimension>
std::vector<CellId> with_those_around(const DiagramState<Dimension>& state, std::vector<CellId> cells) {
  const std::size_t count = cells.size();
  for (std::size_t c = 0; c < count; ++c) {
    for (int i = 0; i <= Dimension; ++i) cells.push_back(state.neighbor(cells[c], i));
  }
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  return cells;
}

template <int Dimension>
std::vector<CellBeads<Dimension>> live_cells(const DiagramState<Dimension>& state) {
  std::vector<CellBeads<Dimension>> cells;
  for (CellId cell = 0; cell < state.triangulation.cells().size(); ++cell) {
    if (state.triangulation.is_live(cell)) cells.push_back(state.beads_of(cell));
  }
  return cells;
}

template <int Dimension>
BeadId least_bead(std::span<const CellBeads<Dimension>> cells) {
  BeadId least = infinite_bead;
  for (const CellBeads<Dimension>& cell : cells)
    for (const BeadId bead : cell) least = std::min(least, bead);
  return least;
}

}  // namespace

template <int Dimension>
void DiagramRebuilder<Dimension>::start_step() {
  coarsest_that_worked_ = coarsest_grid;
  state_.clear_doubt();
}

template <int Dimension>
void DiagramRebuilder<Dimension>::watch_all() {
  facets_.watch_all();
  hidden_.watch_all();
}

template <int Dimension>
void DiagramRebuilder<Dimension>::after_batch() {
  const bool wrong = state_.doubt == Doubt::wrong || is_wrong_just_after(state_);
  std::vector<CellId> cells;  // the cells that may be wrong; empty if they are unknown
  if (state_.known_cells) cells.swap(state_.touched);
  state_.clear_doubt();
  if (wrong && !repair(std::move(cells))) rebuild_at_first_time_that_works();
}

template <int Dimension>
void DiagramRebuilder<Dimension>::build_from_control_points(int k) {
  state_.curves = state_.motion.curves();
  const Eigen::Matrix3Xd points = control_points(state_.curves, k);
  const std::vector<double> weights = control_weights(state_.curves, k);
  RegularTriangulation<Dimension>& triangulation = state_.triangulation;
  if (state_.present_beads.count() == state_.bead_count())
    return forget_steps(triangulation.build(points, weights));
  const std::vector<BeadId> present = state_.present_beads.all();
  const auto built =
      static_diagram(state_, std::span<const BeadId>(present), Dyadic(k == 0 ? 0.0 : 1.0), true);
  triangulation.assign(state_.bead_count(), built.cells);
  triangulation.set_points(points, weights);
  forget_steps(built);
}

template <int Dimension>
void DiagramRebuilder<Dimension>::build_bare_at_end() {
  state_.clear_doubt();
  state_.curves = state_.motion.curves();
  const int k = state_.curves.own_degree();
  forget_steps(
      state_.triangulation.build_bare(control_points(state_.curves, k), control_weights(state_.curves, k)));
}

template <int Dimension>
void DiagramRebuilder<Dimension>::forget_steps(const StaticTriangulation<Dimension>& built) {
  facets_.forget_cells();
  state_.hidden.assign(state_.bead_count(), built.hidden);
  state_.affine_dimension = built.dimension;
  state_.has_had_cells |= built.dimension == Dimension;
  state_.flat = false;
}

template <int Dimension>
bool DiagramRebuilder<Dimension>::assign_static(const Dyadic& time) {
  const std::vector<BeadId> present = state_.present_beads.all();
  const auto built = static_diagram(state_, std::span<const BeadId>(present), time, true);
  if (built.dimension < Dimension) return false;
  state_.affine_dimension = Dimension;
  state_.has_had_cells = true;
  state_.hidden.assign(state_.bead_count(), built.hidden);
  state_.triangulation.assign(state_.bead_count(), built.cells);
  return true;
}

template <int Dimension>
void DiagramRebuilder<Dimension>::drop_all() {
  facets_.drop_all();
  hidden_.drop_all();
}

template <int Dimension>
void DiagramRebuilder<Dimension>::record(const Dyadic& time, std::span<const Beads> cells_before) {
  ++state_.owner.statistics.rebuilds;
  if (time.exponent() > finest_logged_grid) {
    const auto made = exchange_.record(cells_before, live_cells(state_));
    state_.record({Events::repairs, 1, {least_bead<Dimension>(made)}});
    return;
  }
  Change change{Events::rebuild, 1, {time.exponent()}};
  for (Integer rest = time.numerator(); rest != 0 && change.size < change.ids.size(); rest >>= 32U) {
    change.ids[change.size++] = static_cast<BeadId>(mpz_get_ui(rest.get_mpz_t()) & 0xffffffffU);
  }
  state_.record(change);
}

template <int Dimension>
void DiagramRebuilder<Dimension>::apply(const Change& change) {
  if (change.size < 1 || change.ids[0] > finest_logged_grid)
    throw std::invalid_argument("this is no time of a rebuild");
  Integer numerator = 0;
  for (std::size_t i = change.size; i-- > 1;) numerator = (numerator << 32U) + change.ids[i];
  const Dyadic time(numerator, change.ids[0]);
  if (!(time < Dyadic(1.0)) || !assign_static(time))
    throw std::invalid_argument("no diagram can be built at this time");
}

template <int Dimension>
void DiagramRebuilder<Dimension>::assign_logged(std::span<const Beads> cells) {
  state_.triangulation.assign(state_.bead_count(), cells);
  std::vector<BeadId> hidden = state_.present_beads.all();
  std::erase_if(hidden, [this](BeadId bead) { return state_.triangulation.is_vertex(bead); });
  forget_steps({{}, hidden, Dimension});
}

template <int Dimension>
std::vector<ExactTime> DiagramRebuilder<Dimension>::contradictions(const Dyadic& time) {
  std::vector<ExactTime> times;
  ExactTime limit(time);
  // Collects the failures before that time.
  const auto later = [&](const auto& table, CertificateHandle handle) {
    if (!has_slot(handle)) return true;
    ExactTime failure = exact_time(*table.exact_function(slot_of(handle)), table.time(slot_of(handle)));
    if (ExactTime::compare(limit, failure) < 0) return true;
    times.push_back(std::move(failure));
    return times.size() < most_times;
  };
  static_cast<void>(facets_.all_of(later) && hidden_.all_of(later));
  add_beginnings(times);  // certificates that hold then but not just after now
  return times;
}

template <int Dimension>
void DiagramRebuilder<Dimension>::add_beginnings(std::vector<ExactTime>& times) {
  facets_.for_violated(most_times, [&]<class Certificate>(Certificate certificate) {
    certificate.sign = -certificate.sign;
    const auto& search = state_.template search<Certificate>();
    const KnownAtStart known = KnownAtStart::unknown;
    Failure failure;
    search.first_failures(state_.simulator.kernel(), {&certificate, 1}, state_.simulator.now(), {&known, 1},
                          state_.owner.statistics.stages, TouchPolicy::ignored, {&failure, 1});
    if (failure.kind == Failure::Kind::later)
      times.push_back(exact_time(*search.exact_function(certificate), failure.time));
  });
}

template <int Dimension>
bool DiagramRebuilder<Dimension>::repair(std::vector<CellId> wrong) {
  constexpr int rings = 3;
  std::erase_if(wrong, [&](CellId cell) { return !state_.triangulation.is_live(cell); });
  std::sort(wrong.begin(), wrong.end());
  wrong.erase(std::unique(wrong.begin(), wrong.end()), wrong.end());
  for (int ring = 0; ring <= rings; ++ring) {
    if (wrong.empty() || 4 * wrong.size() > state_.triangulation.live_count()) return false;
    if (try_to_repair(wrong)) {
      const bool right =
          state_.doubt != Doubt::wrong && hull_winds_once(state_, std::span<const CellId>(state_.touched));
      state_.clear_doubt();
      return right;
    }
    wrong = with_those_around(state_, std::move(wrong));
  }
  return false;
}

template <int Dimension>
bool DiagramRebuilder<Dimension>::try_to_repair(std::span<const CellId> wrong) {
  std::vector<BeadId> beads;
  for (const CellId cell : wrong) {
    for (const BeadId b : state_.beads_of(cell)) {
      if (b != infinite_bead) beads.push_back(b);
    }
  }
  if (!state_.hidden.empty()) {
    for (const HiddenBead& hidden : state_.hidden.with_hosts()) {
      if (hidden.host != no_cell && std::find(wrong.begin(), wrong.end(), hidden.host) != wrong.end())
        beads.push_back(hidden.bead);
    }
  }
  state_.present = {};
  for (const unsigned bits : {80U, finest_logged_grid}) {  // an event before these times is very unlikely
    const Dyadic time = next_on_grid(state_.simulator.now().exact(), bits);
    if (!(time < Dyadic(1.0))) continue;
    const std::vector<Beads> made = exchange_.fill_of(wrong, beads, time);
    if (made.empty() || !exchange_.can_fill(wrong, made) || !exchange_.is_regular(wrong, made)) continue;
    hidden_.displace(wrong);
    exchange_.fill(wrong, made);
    ++state_.owner.statistics.rebuilds;
    state_.record({Events::repairs, 1, {least_bead<Dimension>(made)}});
    return true;
  }
  return false;
}

template <int Dimension>
bool DiagramRebuilder<Dimension>::try_to_rebuild() {
  std::vector<ExactTime> before;  // a rebuild must precede these times
  add_beginnings(before);
  drop_all();
  facets_.remember();
  state_.present = {};
  const auto cells_before = live_cells(state_);
  bool solid = false;  // whether the beads span space at one of the times tried
  const auto is_late = [&](const Dyadic& time) {
    return std::any_of(before.begin(), before.end(), [limit = ExactTime(time)](ExactTime& other) mutable {
      return ExactTime::compare(limit, other) >= 0;
    });
  };
  for (unsigned bits = coarsest_that_worked_; bits <= finest_grid; bits = next_grid(bits)) {
    const Dyadic time = next_on_grid(state_.simulator.now().exact(), bits);
    if (!(time < Dyadic(1.0)) || (next_grid(bits) <= finest_grid && is_late(time))) continue;
    if (!assign_static(time)) continue;
    solid = true;
    state_.clear_doubt();
    watch_all();
    std::vector<ExactTime> more = contradictions(time);
    if (state_.doubt != Doubt::wrong && more.empty()) {
      state_.clear_doubt();
      facets_.forget_known();
      coarsest_that_worked_ = bits;
      record(time, cells_before);
      return true;
    }
    before.insert(before.end(), more.begin(), more.end());
    drop_all();
  }
  facets_.forget_known();
  state_.clear_doubt();
  if (!solid) return false;
  throw InputError("step " + std::to_string(state_.simulator.step()) +
                   " at u = " + std::to_string(state_.simulator.now().upper()) +
                   ": events of the power diagram within 2^-" + std::to_string(finest_grid) +
                   " of the step, closer than it can be rebuilt between");
}

template <int Dimension>
void DiagramRebuilder<Dimension>::rebuild_at_first_time_that_works() {
  if (!try_to_rebuild()) refuse_flat(state_.simulator.step());
}

template <int Dimension>
void DiagramRebuilder<Dimension>::refuse_flat(std::size_t step) {
  throw InputError(
      std::string("all beads stay ") + (Dimension == 3 ? "in one plane" : "on one line") + " in step " +
      std::to_string(step) + "; the power diagram " +
      (Dimension == 3 ? "in space needs four that do not" : "in the plane needs three that do not"));
}

template class DiagramRebuilder<2>;
template class DiagramRebuilder<3>;

}  // namespace kds
