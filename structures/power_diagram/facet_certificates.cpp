#include "structures/power_diagram/facet_certificates.h"

#include <algorithm>
#include <array>
#include <tuple>

#include "motions/base/grow_little.h"

namespace kds {

template <int Dimension>
FacetCertificates<Dimension>::FacetCertificates(State& state)
    : state_(state),
      power_tests_(state.simulator, state.owner, state.index, powers, state.motion, TouchPolicy::reported),
      orientations_(state.simulator, state.owner, state.index, orientations, state.motion,
                    TouchPolicy::reported),
      proofs_(state) {}

template <int Dimension>
void FacetCertificates<Dimension>::start_step() {
  proofs_.start_step(all_move());
  certified_ = false;
}

template <int Dimension>
void FacetCertificates<Dimension>::move_only(std::vector<char> moving) {
  moving_ = std::move(moving);
  flipped_.clear();
  proofs_.forget_ends();  // steps of other beads end at other positions
  if (!all_move()) proofs_.forget_all();
}

template <int Dimension>
void FacetCertificates<Dimension>::forget_cells() {
  proofs_.forget_all();
  notes_ = Notes::any;
}

template <int Dimension>
void FacetCertificates<Dimension>::drop_all() {
  forget_cells();
  if (certified_) for_all_facets([this](CellId cell, int i) { drop(cell, i); });
}

template <int Dimension>
void FacetCertificates<Dimension>::enqueue(CellId cell, int i) {
  enqueue(CellCertificates(state_.beads_of(cell)), cell, i, KnownAtStart::unknown);
}

template <int Dimension>
void FacetCertificates<Dimension>::enqueue(const CellCertificates<Dimension + 1>& certificates, CellId cell,
                                           int i, KnownAtStart known) {
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
void FacetCertificates<Dimension>::enqueue_in(CertificateTable<Certificate>& table, FacetId place,
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
void FacetCertificates<Dimension>::remember(const CertificateTable<Certificate>& table, FacetId facet,
                                            CertificateHandle handle) {
  Failure failure;
  if (has_slot(handle)) {
    failure = {Failure::Kind::later, table.time(slot_of(handle))};
  } else if (handle == CertificateHandle::zero) {
    failure.kind = Failure::Kind::zero;
  } else if (handle == CertificateHandle::violated) {
    failure.kind = Failure::Kind::at_birth;
  }
  const CellId cell = cell_of(facet);
  Certificate certificate;
  CellCertificates(state_.beads_of(cell)).make(state_.apex(cell, index_of(facet)), certificate);
  known_->add(certificate, failure);
}

template <int Dimension>
void FacetCertificates<Dimension>::watch_all() {
  certified_ = true;
  proofs_.start_facets(all_move());
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
void FacetCertificates<Dimension>::watch_all_moving() {
  if (proofs_.has_slack()) {
    note_skipped();
  } else {
    notes_ = Notes::any;
  }
  const auto proved = proofs_.template prove_all<in_lanes>(
      [this](CellId cell) { state_.triangulation.note_all(cell, skipped_note); },
      [this](CellId cell, int i) { enqueue(cell, i); });
  power_tests_.hold_never(proved.skipped + proved.positive);
  state_.owner.statistics.stages.coefficients += proved.positive;
  state_.owner.statistics.stages.slack += proved.skipped;
}

/// Marks all facets as skipped. Leaves out cells whose notes say so already.
template <int Dimension>
void FacetCertificates<Dimension>::note_skipped() {
  if (notes_ == Notes::skipped) {
    for (const CellId cell : noted_) state_.triangulation.note_all(cell, skipped_note);
  } else {
    for (CellId cell = 0; cell < state_.triangulation.cells().size(); ++cell)
      state_.triangulation.note_all(cell, skipped_note);
  }
  noted_.clear();
  notes_ = Notes::skipped;
}

template <int Dimension>
void FacetCertificates<Dimension>::remember_noted(CellId cell) {
  append_little(noted_, cell);
  if (8 * noted_.size() > state_.triangulation.cells().size()) notes_ = Notes::any;  // too many to list
}

/// Creates the certificates of the facets that have a moving bead.
template <int Dimension>
void FacetCertificates<Dimension>::watch_marked() {
  notes_ = Notes::any;
  RegularTriangulation<Dimension>& triangulation = state_.triangulation;
  const auto moves = [this](BeadId bead) { return bead != infinite_bead && moving_[bead] != 0; };
  std::vector<char> has_moving(triangulation.cells().size(), 0);
  for (CellId cell = 0; cell < has_moving.size(); ++cell) {
    triangulation.note_all(cell, skipped_note);
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
void FacetCertificates<Dimension>::watch_enqueued() {
  const auto take = [this](FacetId facet, CertificateHandle handle, About about) {
    if (handle == CertificateHandle::violated)
      state_.suspect_at(cell_of(facet), state_.neighbor(cell_of(facet), index_of(facet)));
    set_handle(cell_of(facet), index_of(facet), {handle, about});
  };
  power_tests_.watch_enqueued([&](FacetId facet, CertificateHandle handle) {
    if (known_) remember(power_tests_, facet, handle);
    take(facet, handle, About::power);
    if (handle == CertificateHandle::zero) watch_cells_beside(cell_of(facet), index_of(facet));
  });
  orientations_.watch_enqueued([&](FacetId facet, CertificateHandle handle) {
    if (known_) remember(orientations_, facet, handle);
    take(facet, handle, About::hull);
  });
}

/// Replaces a power test that is zero for the whole step by the orientations of both cells.
template <int Dimension>
void FacetCertificates<Dimension>::watch_cells_beside(CellId cell, int i) {
  power_tests_.drop(handle(cell, i).handle);
  for (const auto& [own, k] : {std::pair(cell, i), state_.across(cell, i)}) watch_cell(own, k);
}

template <int Dimension>
void FacetCertificates<Dimension>::watch_cell(CellId cell, int i) {
  const Orientation<Dimension> orientation(state_.beads_of(cell), 1);
  const CertificateHandle handle =
      orientations_.watch(orientation, facet_id(cell, i), state_.known_of(orientation));
  set_own_handle(cell, i, {handle, About::cell});
  if (handle == CertificateHandle::violated) state_.suspect_at(cell, state_.neighbor(cell, i));
}

template <int Dimension>
void FacetCertificates<Dimension>::watch_around(std::span<const CellId> cells) {
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
    if (c % few_cells == 0)
      found = proofs_.found_around(cells.subspan(c, std::min(few_cells, cells.size() - c)));
    const unsigned hold = in_some_part(found[c % few_cells]);
    unsigned outer = 0;
    const CellCertificates certificates(state_.beads_of(cell));
    for (int i = 0; i <= Dimension; ++i) {
      const auto [other, k] = state_.across(cell, i);
      proofs_.forget(cell, i, other, k);
      const auto at = std::find(cells.begin(), cells.end(), other) - cells.begin();
      if (at == static_cast<std::ptrdiff_t>(cells.size())) {
        outer |= 1U << i;
        if ((hold >> i & 1U) != 0) {
          set_handle(cell, i, {CertificateHandle::never, About::power});
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
    proofs_.proved_around(cell, outer, found[c % few_cells]);
  }
  power_tests_.hold_never(positive);
  stages.coefficients += positive;
  watch_enqueued();
}

/// Sets the handle of a facet between two cells made by an event. The event's function has no further root.
template <int Dimension>
void FacetCertificates<Dimension>::hold_inner(CellId cell, int i) {
  const bool on_hull = state_.present.type == Orientation<Dimension>::type.number;
  set_handle(cell, i, {CertificateHandle::never, on_hull ? About::hull : About::power});
  power_tests_.hold_never(1);
}

template <int Dimension>
auto FacetCertificates<Dimension>::take_failure(unsigned table, std::uint32_t slot) -> std::optional<Failed> {
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
  if (handle(cell, facet).about == About::cell) {
    set_own_handle(cell, facet, {CertificateHandle::violated, About::cell});
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
auto FacetCertificates<Dimension>::violated_in_order(std::size_t most) const -> std::vector<Violated> {
  std::vector<Violated> violated;
  const auto add = [&](CellId cell, int i, bool of_cell) {
    if (handle(cell, i).handle != CertificateHandle::violated) return;
    Violated facet{{}, of_cell, cell, i};
    const Beads& v = state_.beads_of(cell);
    std::copy(v.begin(), v.end(), facet.beads.begin());
    facet.beads.back() = of_cell ? no_bead : state_.apex(cell, i);
    std::sort(facet.beads.begin(), facet.beads.end());
    violated.push_back(facet);
  };
  for_all_facets([&](CellId cell, int i) {
    const bool of_cell = handle(cell, i).about == About::cell;
    add(cell, i, of_cell);
    if (!of_cell) return;
    const auto [other, k] = state_.across(cell, i);
    add(other, k, true);
  });
  std::sort(violated.begin(), violated.end(), [](const Violated& a, const Violated& b) {
    return std::tie(a.of_cell, a.beads) < std::tie(b.of_cell, b.beads);
  });
  if (violated.size() > most) violated.resize(most);
  return violated;
}

template <int Dimension>
void FacetCertificates<Dimension>::fetch(CellId cell, bool next) const {
  state_.triangulation.fetch(cell, next);
  if (!next) return;
  for (int i = 0; i <= Dimension; ++i) {
    if (const FacetHandle facet = handle(cell, i); facet.about == About::power)
      power_tests_.fetch(facet.handle);
  }
  const auto& named = state_.triangulation.cells()[cell];
  for (const auto* beads : {&named.vertex, &named.apex}) {
    for (const BeadId bead : *beads) {
      if (bead != infinite_bead) __builtin_prefetch(state_.curves.control_point(bead, 0));
    }
  }
}

template class FacetCertificates<2>;
template class FacetCertificates<3>;

}  // namespace kds
