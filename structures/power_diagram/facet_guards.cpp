#include "structures/power_diagram/facet_guards.h"

#include <algorithm>
#include <array>
#include <bit>

#include "motions/base/grow_little.h"

namespace kds {

template <int Dimension>
FacetGuards<Dimension>::FacetGuards(State& state)
    : state_(state),
      power_tests_(state.simulator, state.owner, state.index, powers, state.motion, TouchPolicy::reported),
      orientations_(state.simulator, state.owner, state.index, orientations, state.motion,
                    TouchPolicy::reported),
      filter_(cell_filter_over(state.motion)),
      filter_ahead_(cell_filter_over<Dimension>(foresight_.ahead(), FilterOf::parts)) {}

template <int Dimension>
void FacetGuards<Dimension>::start_step() {
  // Slack is computed as if weights were constant.
  if (state_.simulator.kernel() != Kernel::exact && !state_.motion.is_lifted() && all_move())
    slack_.start_step(state_.curves, state_.triangulation);
  if (state_.simulator.kernel() == Kernel::exact || state_.motion.is_lifted() ||
      state_.motion.degree() != 1 || !all_move() || slack_.any()) {
    foresight_.forget_all();
  } else {
    foresight_.start_step(state_.curves, state_.triangulation);
  }
  guarded_ = false;
  ends_positive_.clear();
}

template <int Dimension>
void FacetGuards<Dimension>::move_only(std::vector<char> moving) {
  moving_ = std::move(moving);
  flipped_.clear();
  ends_positive_.clear();  // steps of other beads end at other positions
  if (all_move()) return;
  slack_.forget_all();
  foresight_.forget_all();
}

template <int Dimension>
void FacetGuards<Dimension>::forget_cells() {
  slack_.forget_all();
  foresight_.forget_all();
  ends_positive_.clear();
  notes_ = Notes::any;
}

template <int Dimension>
void FacetGuards<Dimension>::drop_all() {
  forget_cells();
  if (guarded_) for_all_facets([this](CellId cell, int i) { drop(cell, i); });
}

template <int Dimension>
void FacetGuards<Dimension>::enqueue(CellId cell, int i) {
  enqueue(FacetCertificates(state_.beads_of(cell)), cell, i, KnownAtStart::unknown);
}

template <int Dimension>
void FacetGuards<Dimension>::enqueue(const FacetCertificates<Dimension + 1>& certificates, CellId cell, int i,
                                     KnownAtStart known) {
  // Which side reports the facet depends on which facets the filters proved. The facet's place must not
  // depend on it, because the place determines the order of simultaneous failures and the cells that a flip
  // makes.
  const FacetId place = std::min(facet_id(cell, i), state_.triangulation.beyond(cell, i));
  const BeadId beyond = state_.apex(cell, i);
  const auto make = [&](auto& certificate) { certificates.make(beyond, certificate); };
  if (certificates.on_hull(beyond)) {
    enqueue_in(orientations_, place, known, make);
  } else {
    enqueue_in(power_tests_, place, known, make);
  }
}

template <int Dimension>
template <class Certificate, class Make>
void FacetGuards<Dimension>::enqueue_in(CertificateTable<Certificate>& table, FacetId place,
                                        KnownAtStart birth, Make make) {
  if (known_ && birth == KnownAtStart::unknown) {
    Certificate certificate;
    make(certificate);
    if (const Failure* failure = known_->of(certificate)) {
      ++state_.owner.statistics.stages.shared;
      return table.enqueue_known(certificate, place, *failure);
    }
  }
  make(table.one_of_many(place, birth));
}

template <int Dimension>
template <class Certificate>
void FacetGuards<Dimension>::remember(const CertificateTable<Certificate>& table, FacetId facet,
                                      CertificateHandle guard) {
  Failure failure;
  if (has_slot(guard)) {
    failure = {Failure::Kind::later, table.time(slot_of(guard))};
  } else if (guard == CertificateHandle::zero) {
    failure.kind = Failure::Kind::zero;
  } else if (guard == CertificateHandle::violated) {
    failure.kind = Failure::Kind::at_birth;
  }
  const CellId cell = cell_of(facet);
  Certificate certificate;
  FacetCertificates(state_.beads_of(cell)).make(state_.apex(cell, index_of(facet)), certificate);
  known_->add(certificate, failure);
}

template <int Dimension>
void FacetGuards<Dimension>::watch_all() {
  guarded_ = true;
  ends_positive_.assign(all_move() ? state_.triangulation.cells().size() : 0, 0);
  unit_ = LengthUnit(exponent_of_length(state_.curves, state_.triangulation.cells()));
  if (!all_move()) {
    watch_marked();
  } else if (state_.simulator.kernel() == Kernel::exact) {
    watch_all_moving<false>();
  } else {
    watch_all_moving<true>();
  }
  watch_enqueued();
}

template <int Dimension>
template <bool in_lanes>
void FacetGuards<Dimension>::watch_all_moving() {
  const auto found = taking_doubts();
  FacetFilter<Dimension> positive(*filter_, unit_, rounding_of(state_.simulator.kernel()));
  RegularTriangulation<Dimension>& triangulation = state_.triangulation;
  const auto cells = triangulation.cells();
  const auto look_at = [&](CellId cell, unsigned facets, unsigned finite) {
    if constexpr (in_lanes)
      if (finite != 0) positive.look_at(cells[cell], cell, facets & finite, found);
    for (unsigned left = facets & ~finite; left != 0; left &= left - 1) enqueue(cell, std::countr_zero(left));
  };
  const auto finite_of = [&](CellId cell) { return in_lanes ? finite_facets(cells[cell]) : 0; };
  std::uint64_t at_rest = 0;
  if (foresight_.any()) {
    at_rest = watch_with_foresight(positive);
  } else if (slack_.any()) {
    note_resting();
    std::uint64_t others = 0;
    slack_.for_the_others(triangulation, [&](CellId cell, unsigned facets) {
      others += count_of<Dimension>(facets);
      look_at(cell, facets, finite_of(cell));
    });
    at_rest = triangulation.live_count() * (Dimension + 1) / 2 - others;
  } else {
    constexpr std::size_t ahead = 12;
    notes_ = Notes::any;
    cover_.start(cells.size());
    for (CellId cell = 0; cell < cells.size(); ++cell) {
      if (!triangulation.is_live(cell)) continue;
      __builtin_prefetch(&cells[cell] + ahead);
      triangulation.note_all(cell, resting_note);
      const unsigned finite = finite_of(cell);
      look_at(cell, cover_.facets_of(cells[cell], cell, finite == all_facets<Dimension>), finite);
    }
  }
  if constexpr (in_lanes) positive.finish(found);
  power_tests_.hold_never(at_rest + positive.count());
  state_.owner.statistics.stages.coefficients += positive.count();
  state_.owner.statistics.stages.slack += at_rest;
}

/// Gives certificates to facets that are not found positive.
template <int Dimension>
auto FacetGuards<Dimension>::taking_doubts() {
  return [this](CellId cell, unsigned wanted, unsigned positive) {
    for (unsigned doubts = wanted & ~positive; doubts != 0; doubts &= doubts - 1)
      enqueue(cell, std::countr_zero(doubts));
    ends_positive_[cell] = (positive & positive_at_end<Dimension>) != 0 ? 1 : 0;
  };
}

template <int Dimension>
std::uint64_t FacetGuards<Dimension>::watch_with_foresight(FacetFilter<Dimension>& positive) {
  RegularTriangulation<Dimension>& triangulation = state_.triangulation;
  const auto cells = triangulation.cells();
  notes_ = Notes::any;
  std::uint64_t others = 0;
  const auto found = taking_doubts();
  const bool all_known = foresight_.ahead().all_known();
  const auto found_ahead = [&](CellId cell, unsigned wanted, unsigned positive_parts_of_step) {
    foresight_.proved(cell, wanted, positive_parts_of_step);
    unsigned doubts = wanted & ~in_some_part(positive_parts_of_step);
    if (doubts == 0) return;
    others += count_of<Dimension>(doubts);
    if (!all_known) return positive.look_at(cells[cell], cell, doubts, found);
    for (; doubts != 0; doubts &= doubts - 1) enqueue(cell, std::countr_zero(doubts));
  };
  FacetFilter<Dimension> ahead(*filter_ahead_, unit_, rounding_of(state_.simulator.kernel()));
  on_hull_.clear();
  const auto rests = [&](CellId cell) { triangulation.note_all(cell, resting_note); };
  foresight_.for_the_others(triangulation, rests, [&](CellId cell, unsigned facets) {
    const unsigned finite = finite_facets(cells[cell]);
    for (unsigned left = facets & ~finite; left != 0; left &= left - 1)
      on_hull_.push_back(facet_id(cell, std::countr_zero(left)));
    if (finite == 0 && state_.is_infinite(cell)) {
      foresight_.stays_positive_ahead(cell);
    } else {
      ahead.look_at(cells[cell], cell, facets & finite, found_ahead);
    }
  });
  ahead.finish(found_ahead);
  others += watch_hull_ahead();
  for (CellId cell = 0; cell < ends_positive_.size(); ++cell)
    if (foresight_.stays_positive(cell)) ends_positive_[cell] = 1;
  return triangulation.live_count() * (Dimension + 1) / 2 - others;
}

/// Facets of the hull are guarded by an orientation, like cells. Returns the number of facets not found to
/// hold.
template <int Dimension>
std::uint64_t FacetGuards<Dimension>::watch_hull_ahead() {
  std::uint64_t doubts = 0;
  for (std::size_t first = 0; first < on_hull_.size(); first += cells_in_batch) {
    const std::size_t count = std::min(cells_in_batch, on_hull_.size() - first);
    CellsInLanes<Dimension> beads;
    for (std::size_t lane = 0; lane < cells_in_batch; ++lane) {
      const FacetId facet = on_hull_[first + (lane < count ? lane : 0)];
      Orientation<Dimension> orientation;
      FacetCertificates(state_.beads_of(cell_of(facet)))
          .make(state_.apex(cell_of(facet), index_of(facet)), orientation);
      std::copy(orientation.beads.begin(), orientation.beads.end(), beads[lane].begin());
      if (!orientation.side()) std::swap(beads[lane][0], beads[lane][1]);
    }
    PositiveBits positive;
    filter_ahead_->positive_cells(beads, 0, unit_, rounding_of(state_.simulator.kernel()), positive);
    for (std::size_t lane = 0; lane < count; ++lane) {
      const CellId cell = cell_of(on_hull_[first + lane]);
      const int i = index_of(on_hull_[first + lane]);
      int part = 0;
      while (part <= positive_parts &&
             (positive[lane] >> (part * bits_of_part) & positive_throughout<Dimension>) == 0)
        ++part;
      if (part > positive_parts) {
        ++doubts;
        enqueue(cell, i);
      } else {
        foresight_.proved(cell, i, static_cast<int>(MotionAhead<Dimension>::steps) >> part);
      }
    }
  }
  return doubts;
}

/// Marks all facets as resting. Skips cells whose notes say so already.
template <int Dimension>
void FacetGuards<Dimension>::note_resting() {
  if (notes_ == Notes::resting) {
    for (const CellId cell : noted_) state_.triangulation.note_all(cell, resting_note);
  } else {
    for (CellId cell = 0; cell < state_.triangulation.cells().size(); ++cell)
      state_.triangulation.note_all(cell, resting_note);
  }
  noted_.clear();
  notes_ = Notes::resting;
}

template <int Dimension>
void FacetGuards<Dimension>::remember_noted(CellId cell) {
  append_little(noted_, cell);
  if (8 * noted_.size() > state_.triangulation.cells().size()) notes_ = Notes::any;  // too many to list
}

/// Guards the facets that have a moving bead.
template <int Dimension>
void FacetGuards<Dimension>::watch_marked() {
  notes_ = Notes::any;
  RegularTriangulation<Dimension>& triangulation = state_.triangulation;
  const auto moves = [this](BeadId bead) { return bead != infinite_bead && moving_[bead] != 0; };
  std::vector<char> has_moving(triangulation.cells().size(), 0);
  for (CellId cell = 0; cell < has_moving.size(); ++cell) {
    triangulation.note_all(cell, resting_note);
    const Beads& v = state_.beads_of(cell);
    has_moving[cell] = triangulation.is_live(cell) && std::any_of(v.begin(), v.end(), moves) ? 1 : 0;
  }
  std::uint64_t watched = 0, all = 0;
  for (CellId cell = 0; cell < has_moving.size(); ++cell) {
    if (triangulation.is_live(cell)) all += Dimension + 1;
    if (has_moving[cell] == 0) continue;
    for (int i = 0; i <= Dimension; ++i) {
      const CellId other = state_.neighbor(cell, i);
      if (has_moving[other] != 0 && other < cell) continue;
      enqueue(cell, i);
      ++watched;
    }
  }
  power_tests_.hold_never(all / 2 - watched);
}

template <int Dimension>
void FacetGuards<Dimension>::watch_enqueued() {
  const auto take = [this](FacetId facet, CertificateHandle guard, About about) {
    if (guard == CertificateHandle::violated)
      state_.suspect_at(cell_of(facet), state_.neighbor(cell_of(facet), index_of(facet)));
    set_guard(cell_of(facet), index_of(facet), {guard, about});
  };
  power_tests_.watch_enqueued([&](FacetId facet, CertificateHandle guard) {
    if (known_) remember(power_tests_, facet, guard);
    take(facet, guard, About::power);
    if (guard == CertificateHandle::zero) watch_cells_beside(cell_of(facet), index_of(facet));
  });
  orientations_.watch_enqueued([&](FacetId facet, CertificateHandle guard) {
    if (known_) remember(orientations_, facet, guard);
    take(facet, guard, About::hull);
  });
}

/// Replaces a power test that is zero for the whole step by the orientations of both cells.
template <int Dimension>
void FacetGuards<Dimension>::watch_cells_beside(CellId cell, int i) {
  power_tests_.drop(guard(cell, i).guard);
  for (const auto& [own, k] : {std::pair(cell, i), state_.across(cell, i)}) watch_cell(own, k);
}

template <int Dimension>
void FacetGuards<Dimension>::watch_cell(CellId cell, int i) {
  const Orientation<Dimension> orientation(state_.beads_of(cell), 1);
  const CertificateHandle guard =
      orientations_.watch(orientation, facet_id(cell, i), state_.known_of(orientation));
  set_own_guard(cell, i, {guard, About::cell});
  if (guard == CertificateHandle::violated) state_.suspect_at(cell, state_.neighbor(cell, i));
}

/// Returns for each of at most four new cells what the filters find: facets whose power test is positive over
/// the whole step, as it is for most facets to older cells, and over some steps ahead if looking ahead pays.
template <int Dimension>
auto FacetGuards<Dimension>::found_around(std::span<const CellId> cells) -> std::array<unsigned, few_cells> {
  const Kernel kernel = state_.simulator.kernel();
  std::array<unsigned, few_cells> found{};
  const bool ahead = looks_ahead();
  if (kernel != Kernel::exact)
    found = filter_few_cells(ahead ? *filter_ahead_ : *filter_, unit_, rounding_of(kernel),
                             state_.triangulation.cells(), cells);
  grow_little(ends_positive_, state_.triangulation.cells().size());
  const unsigned is_positive = ahead ? positive_throughout<Dimension> : positive_at_end<Dimension>;
  for (std::size_t c = 0; c < cells.size(); ++c)
    ends_positive_[cells[c]] = (in_some_part(found[c]) & is_positive) != 0 ? 1 : 0;
  return found;
}

template <int Dimension>
void FacetGuards<Dimension>::watch_around(std::span<const CellId> cells) {
  if (!all_move()) flipped_.insert(flipped_.end(), cells.begin(), cells.end());
  state_.touch(cells);
  StageCounts& stages = state_.owner.statistics.stages;
  const bool in_event = state_.present != Identity{};
  const KnownAtStart known = in_event ? KnownAtStart::at_own_root : KnownAtStart::unknown;
  const bool inner_hold = in_event && state_.simulator.now().last();
  bool first_inner = true;
  std::uint64_t positive = 0;
  std::array<unsigned, few_cells> found{};
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const CellId cell = cells[c];
    if (c % few_cells == 0) found = found_around(cells.subspan(c, std::min(few_cells, cells.size() - c)));
    const unsigned hold = in_some_part(found[c % few_cells]);
    unsigned outer = 0;
    const FacetCertificates certificates(state_.beads_of(cell));
    for (int i = 0; i <= Dimension; ++i) {
      const auto [other, k] = state_.across(cell, i);
      slack_.forget(cell, i);
      slack_.forget(other, k);
      foresight_.forget(cell, i, other, k);
      const auto at = std::find(cells.begin(), cells.end(), other) - cells.begin();
      if (at == static_cast<std::ptrdiff_t>(cells.size())) {
        outer |= 1U << i;
        if ((hold >> i & 1U) != 0) {
          set_guard(cell, i, {CertificateHandle::never, About::power});
          ++positive;
        } else {
          enqueue(certificates, cell, i, KnownAtStart::unknown);
        }
      } else if (at < static_cast<std::ptrdiff_t>(c)) {
        continue;  // handled already
      } else if (inner_hold) {
        hold_inner(cell, i);
        ++(first_inner ? stages.isolation : stages.shared);
        first_inner = false;
      } else {
        enqueue(certificates, cell, i, known);
      }
    }
    if (looks_ahead()) foresight_.proved(cell, outer, found[c % few_cells]);
  }
  power_tests_.hold_never(positive);
  stages.coefficients += positive;
  watch_enqueued();
}

/// Sets the guard of a facet between two cells made by an event. The event's function has no further root.
template <int Dimension>
void FacetGuards<Dimension>::hold_inner(CellId cell, int i) {
  const bool on_hull = state_.present.type == Orientation<Dimension>::type.number;
  set_guard(cell, i, {CertificateHandle::never, on_hull ? About::hull : About::power});
  power_tests_.hold_never(1);
}

template <int Dimension>
auto FacetGuards<Dimension>::take_failure(unsigned table, std::uint32_t slot) -> std::optional<Failed> {
  const FacetId place =
      table == powers ? power_tests_.place_in_structure(slot) : orientations_.place_in_structure(slot);
  const CellId cell = cell_of(place);
  const int facet = index_of(place);
  state_.triangulation.fetch_around(cell, facet);
  fetch_scheduled(cell);
  fetch_scheduled(state_.neighbor(cell, facet));
  const bool touch = table == powers ? power_tests_.touches(slot) : orientations_.touches(slot);
  if (touch || state_.doubt == Doubt::wrong) state_.touch(std::array{cell, state_.neighbor(cell, facet)});
  if (touch) state_.suspect(Doubt::unclear);
  if (guard(cell, facet).about == About::cell) {
    set_own_guard(cell, facet, {CertificateHandle::violated, About::cell});
    if (touch) {
      watch_cell(cell, facet);
    } else {
      // Cospherical cells turn over: no flip describes this event.
      state_.suspect_at(cell, state_.neighbor(cell, facet));
    }
    return std::nullopt;
  }
  forget(cell, facet);
  if (state_.doubt == Doubt::wrong) return std::nullopt;
  if (touch) {
    enqueue(cell, facet);
    watch_enqueued();
    return std::nullopt;
  }
  return Failed{cell, facet, table == powers ? power_tests_.identity(slot) : orientations_.identity(slot)};
}

template <int Dimension>
void FacetGuards<Dimension>::fetch(CellId cell, bool next) const {
  state_.triangulation.fetch(cell, next);
  if (!next) return;
  for (int i = 0; i <= Dimension; ++i) {
    if (const FacetGuard facet = guard(cell, i); facet.about == About::power) power_tests_.fetch(facet.guard);
  }
  const auto& named = state_.triangulation.cells()[cell];
  for (const auto* beads : {&named.vertex, &named.apex}) {
    for (const BeadId bead : *beads) {
      if (bead != infinite_bead) __builtin_prefetch(state_.curves.control_point(bead, 0));
    }
  }
}

template class FacetGuards<2>;
template class FacetGuards<3>;

}  // namespace kds
