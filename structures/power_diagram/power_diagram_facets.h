#pragma once
// Part of PowerDiagram: the certificates of facets, made and given up together.

#include "structures/power_diagram/power_diagram.h"

namespace kds {

template <Motion M, Kernel K>
void PowerDiagram<M, K>::enqueue(CellId cell, int i) {
  enqueue(FacetCertificates(triangulation_.cells()[cell].vertex), cell, i, KnownAtStart::unknown);
}

template <Motion M, Kernel K>
void PowerDiagram<M, K>::enqueue(const FacetCertificates<dimension + 1>& certificates, CellId cell, int i,
                                 KnownAtStart birth) {
  // Either side may tell, which depends on what filters proved. Not so the facet's place: in which order
  // failures of one time are handled, and what a flip makes.
  const FacetId place = std::min(facet_id(cell, i), triangulation_.beyond(cell, i));
  const BeadId beyond = apex(cell, i);
  if (certificates.on_hull(beyond)) {
    certificates.make(beyond, orientations_.one_of_many(place, birth));
  } else {
    certificates.make(beyond, power_tests_.one_of_many(place, birth));
  }
}

/// Guards all facets; those that rest in this step need no certificate, and those whose test is positive all
/// over the step, as most are, nothing but to be counted.
template <Motion M, Kernel K>
void PowerDiagram<M, K>::watch_all() {
  guarded_ = true;
  ends_positive_.assign(moving_.empty() ? triangulation_.cells().size() : 0, 0);
  unit_ = LengthUnit(exponent_of_length(motion_, triangulation_.cells()));
  if (!moving_.empty()) return watch_moving();
  FacetFilter<M> positive(motion_, unit_);
  Finding finding{*this};
  const auto cells = triangulation_.cells();
  const auto look_at = [&](CellId cell, unsigned facets, unsigned in_lanes) {
    if constexpr (std::same_as<K, Filtered>)
      if (in_lanes != 0) positive.look_at(cells[cell], cell, facets & in_lanes, finding);
    for (unsigned left = facets & ~in_lanes; left != 0; left &= left - 1)
      enqueue(cell, std::countr_zero(left));
  };
  const auto lanes_of = [&](CellId cell) {
    return std::same_as<K, Filtered> ? finite_facets(cells[cell]) : 0;
  };
  std::uint64_t at_rest = 0;
  if (tolerances_.any()) {
    note_resting();
    std::uint64_t others = 0;
    tolerances_.for_the_others(triangulation_, [&](CellId cell, unsigned facets) {
      others += count_of<dimension>(facets);
      look_at(cell, facets, lanes_of(cell));
    });
    at_rest = triangulation_.live_count() * (dimension + 1) / 2 - others;
  } else {
    constexpr std::size_t ahead = 12;
    notes_ = Notes::any;
    cover_.start(cells.size());
    for (CellId cell = 0; cell < cells.size(); ++cell) {
      if (!triangulation_.is_live(cell)) continue;
      __builtin_prefetch(&cells[cell] + ahead);
      triangulation_.note_all(cell, resting_note);
      const unsigned in_lanes = lanes_of(cell);
      look_at(cell, cover_.facets_of(cells[cell], cell, in_lanes == all_facets<dimension>), in_lanes);
    }
  }
  if constexpr (std::same_as<K, Filtered>) positive.finish(finding);
  power_tests_.hold_never(at_rest + positive.count());
  statistics.stages.coefficients += positive.count();
  statistics.stages.tolerance += at_rest;
  watch_enqueued();
  watch_all_hidden();
}

/// Notes of all facets that they rest: cells whose notes say so already are not touched.
template <Motion M, Kernel K>
void PowerDiagram<M, K>::note_resting() {
  if (notes_ == Notes::resting) {
    for (const CellId cell : noted_) triangulation_.note_all(cell, resting_note);
  } else {
    for (CellId cell = 0; cell < triangulation_.cells().size(); ++cell)
      triangulation_.note_all(cell, resting_note);
  }
  noted_.clear();
  notes_ = Notes::resting;
}

/// Guards the facets with a bead that moves.
template <Motion M, Kernel K>
void PowerDiagram<M, K>::watch_moving() {
  notes_ = Notes::any;
  const auto moves = [this](BeadId bead) { return bead != infinite_bead && moving_[bead] != 0; };
  std::vector<char> has_moving(triangulation_.cells().size(), 0);
  for (CellId cell = 0; cell < has_moving.size(); ++cell) {
    triangulation_.note_all(cell, resting_note);
    const Beads& v = triangulation_.cells()[cell].vertex;
    has_moving[cell] = triangulation_.is_live(cell) && std::any_of(v.begin(), v.end(), moves) ? 1 : 0;
  }
  std::uint64_t watched = 0, all = 0;
  for (CellId cell = 0; cell < has_moving.size(); ++cell) {
    if (triangulation_.is_live(cell)) all += dimension + 1;
    if (has_moving[cell] == 0) continue;
    for (int i = 0; i <= dimension; ++i) {
      const CellId other = neighbor(cell, i);
      if (has_moving[other] != 0 && other < cell) continue;
      enqueue(cell, i);
      ++watched;
    }
  }
  power_tests_.hold_never(all / 2 - watched);
  watch_enqueued();
  watch_all_hidden();
}

template <Motion M, Kernel K>
void PowerDiagram<M, K>::watch_enqueued() {
  const auto take = [this](FacetId facet, CertificateHandle guard, About about) {
    if (guard == CertificateHandle::violated) suspect(Doubt::wrong);
    set_guard(cell_of(facet), index_of(facet), {guard, about});
  };
  power_tests_.watch_enqueued([&](FacetId facet, CertificateHandle guard) {
    take(facet, guard, About::power);
    if (guard == CertificateHandle::zero) watch_cells_beside(cell_of(facet), index_of(facet));
  });
  orientations_.watch_enqueued(
      [&](FacetId facet, CertificateHandle guard) { take(facet, guard, About::hull); });
  const auto take_hidden = [this](BeadId bead, int i, CertificateHandle guard) {
    if (guard == CertificateHandle::violated) suspect(Doubt::wrong);
    hidden_guards_[bead][static_cast<std::size_t>(i)] = guard;
  };
  appearances_.watch_enqueued(
      [&](BeadId bead, CertificateHandle guard) { take_hidden(bead, dimension + 1, guard); });
  departures_.watch_enqueued(
      [&](FacetId place, CertificateHandle guard) { take_hidden(cell_of(place), index_of(place), guard); });
}

/// Where a power test is zero for the whole step.
template <Motion M, Kernel K>
void PowerDiagram<M, K>::watch_cells_beside(CellId cell, int i) {
  power_tests_.drop(guard(cell, i).guard);
  for (const auto& [own, k] : {std::pair(cell, i), across(cell, i)}) watch_cell(own, k);
}

template <Motion M, Kernel K>
void PowerDiagram<M, K>::watch_cell(CellId cell, int i) {
  const Orientation<dimension> orientation(triangulation_.cells()[cell].vertex, 1);
  const CertificateHandle guard = orientations_.watch(orientation, facet_id(cell, i), birth_of(orientation));
  set_own_guard(cell, i, {guard, About::cell});
  if (guard == CertificateHandle::violated) suspect(Doubt::wrong);
}

/// Gives up a guard. One of other beads that fails right now as well would have meant another change.
template <Motion M, Kernel K>
template <class Certificate>
void PowerDiagram<M, K>::give_up(CertificateTable<Certificate, M, K>& table, CertificateHandle guard) {
  if (has_slot(guard) && table.time(slot_of(guard)).lower <= simulator_.now().upper() &&
      table.identity(slot_of(guard)) != present_)
    suspect(Doubt::unclear);
  table.drop(guard);
}

template <Motion M, Kernel K>
void PowerDiagram<M, K>::drop(CellId cell, int i) {
  const FacetGuard facet = guard(cell, i);
  if (facet.about == About::power) {
    give_up(power_tests_, facet.guard);
  } else {
    give_up(orientations_, facet.guard);
  }
  if (facet.about == About::cell) {
    const auto [other, k] = across(cell, i);
    give_up(orientations_, guard(other, k).guard);
  }
  forget(cell, i);
}

/// Of each of a few new cells the facets whose power test is known to be positive all over the step, as most
/// to other cells than these are.
template <Motion M, Kernel K>
auto PowerDiagram<M, K>::positive_all_over(std::span<const CellId> cells) -> std::array<unsigned, few_cells> {
  FewPositive found;
  if constexpr (std::same_as<K, Filtered>)
    found = filter_few_cells(motion_, unit_, triangulation_.cells(), cells);
  grow_little(ends_positive_, triangulation_.cells().size());
  for (std::size_t c = 0; c < cells.size(); ++c) ends_positive_[cells[c]] = found.at_end[c] ? 1 : 0;
  return found.facets;
}

/// Guards all facets of the new cells. Those between two of them, where an event made these, have all of its
/// beads, and its function.
template <Motion M, Kernel K>
void PowerDiagram<M, K>::watch_around(std::span<const CellId> cells) {
  if (!moving_.empty()) flipped_.insert(flipped_.end(), cells.begin(), cells.end());
  const bool in_event = present_ != Identity{};
  const KnownAtStart birth = in_event ? KnownAtStart::at_own_root : KnownAtStart::unknown;
  const bool inner_hold = in_event && simulator_.now().last();
  bool first_inner = true;
  std::uint64_t positive = 0;
  std::array<unsigned, few_cells> known{};
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const CellId cell = cells[c];
    if (c % few_cells == 0)
      known = positive_all_over(cells.subspan(c, std::min(few_cells, cells.size() - c)));
    const FacetCertificates certificates(triangulation_.cells()[cell].vertex);
    for (int i = 0; i <= dimension; ++i) {
      const auto [other, k] = across(cell, i);
      tolerances_.forget(cell, i);
      tolerances_.forget(other, k);
      const auto at = std::find(cells.begin(), cells.end(), other) - cells.begin();
      if (at == static_cast<std::ptrdiff_t>(cells.size())) {
        if ((known[c % few_cells] >> i & 1U) != 0) {
          set_guard(cell, i, {CertificateHandle::never, About::power});
          ++positive;
        } else {
          enqueue(certificates, cell, i, KnownAtStart::unknown);
        }
      } else if (at < static_cast<std::ptrdiff_t>(c)) {
        continue;  // met already
      } else if (inner_hold) {
        hold_inner(cell, i);
        ++(first_inner ? statistics.stages.isolation : statistics.stages.shared);
        first_inner = false;
      } else {
        enqueue(certificates, cell, i, birth);
      }
    }
  }
  power_tests_.hold_never(positive);
  statistics.stages.coefficients += positive;
  watch_enqueued();
}

/// A facet between two cells of an event whose function has no root any more.
template <Motion M, Kernel K>
void PowerDiagram<M, K>::hold_inner(CellId cell, int i) {
  const bool on_hull = present_.type == static_cast<std::uint32_t>(CertificateType::orientation);
  set_guard(cell, i, {CertificateHandle::never, on_hull ? About::hull : About::power});
  power_tests_.hold_never(1);
}

/// A cell's own facets name all of its vertices but one each, and the beads beyond them: a bead is named by
/// half its cells' facets with it, each shared by two of its cells, and once by each of its cells for the
/// facet opposite to it. In space that makes 5/2 for each cell, in the plane 2.
template <Motion M, Kernel K>
void PowerDiagram<M, K>::count_certificates_per_bead() {
  const auto count_of = [](std::uint64_t cells) { return cells * (dimension + 2) / 2; };
  const auto cells_at = triangulation_.cells_at();
  std::uint64_t most = 0;
  if (!cells_at.empty()) most = count_of(*std::max_element(cells_at.begin(), cells_at.end()));
  if (!hidden_.empty()) {
    std::vector<std::uint64_t> more(motion_.bead_count(), 0);
    for (const BeadId bead : hidden_.beads()) {
      if (hidden_.host(bead) == no_cell) continue;
      more[bead] += dimension + 2;
      for (int k = 0; k <= dimension; ++k) more[vertex(hidden_.host(bead), k)] += dimension + 1;
    }
    for (BeadId b = 0; b < more.size(); ++b) most = std::max(most, more[b] + count_of(cells_at[b]));
  }
  statistics.certificates.per_bead_max = std::max(statistics.certificates.per_bead_max, most);
}

}  // namespace kds
