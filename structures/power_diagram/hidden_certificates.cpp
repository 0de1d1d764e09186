#include "structures/power_diagram/hidden_certificates.h"

#include <algorithm>
#include <array>
#include <tuple>

namespace kds {

template <int Dimension>
HiddenCertificates<Dimension>::HiddenCertificates(State& state)
    : state_(state),
      appearances_(state.simulator, state.owner, state.index, appearing, state.motion),
      departures_(state.simulator, state.owner, state.index, departing, state.motion) {}

template <int Dimension>
void HiddenCertificates<Dimension>::enqueue(BeadId bead) {
  const Beads& v = state_.beads_of(state_.hidden.host(bead));
  for (int i = 0; i <= Dimension; ++i) {
    const Orientation<Dimension> inside(State::with(v, i, bead), 1);
    departures_.enqueue_one_of_many(inside, facet_id(bead, i), state_.known_of(inside));
  }
  std::array<BeadId, Dimension + 2> beads{};
  std::copy(v.begin(), v.end(), beads.begin());
  beads.back() = bead;
  const PowerTest<Dimension> above(beads, 1);
  appearances_.enqueue_one_of_many(above, bead, state_.known_of(above));
}

template <int Dimension>
void HiddenCertificates<Dimension>::watch_enqueued() {
  const auto take = [this](BeadId bead, int i, CertificateHandle handle) {
    if (handle == CertificateHandle::violated) state_.suspect(Doubt::wrong);
    handles_[bead][static_cast<std::size_t>(i)] = handle;
  };
  appearances_.watch_enqueued(
      [&](BeadId bead, CertificateHandle handle) { take(bead, Dimension + 1, handle); });
  departures_.watch_enqueued(
      [&](FacetId place, CertificateHandle handle) { take(cell_of(place), index_of(place), handle); });
}

template <int Dimension>
void HiddenCertificates<Dimension>::watch(BeadId bead) {
  enqueue(bead);
  watch_enqueued();
}

template <int Dimension>
void HiddenCertificates<Dimension>::enter(BeadId bead, CellId host) {
  state_.hidden.enter(bead, host);
  watch(bead);
}

template <int Dimension>
void HiddenCertificates<Dimension>::hide(BeadId bead) {
  state_.hidden.hide(bead);
  handles_.resize(state_.bead_count(), no_handles);
}

template <int Dimension>
void HiddenCertificates<Dimension>::drop(BeadId bead) {
  for (std::size_t i = 0; i <= Dimension; ++i) state_.give_up(departures_, handles_[bead][i]);
  state_.give_up(appearances_, handles_[bead].back());
  handles_[bead] = no_handles;
}

template <int Dimension>
void HiddenCertificates<Dimension>::drop_all() {
  for (BeadId bead = 0; bead < handles_.size(); ++bead) drop(bead);
}

template <int Dimension>
void HiddenCertificates<Dimension>::watch_all() {
  const HiddenBeads& hidden = state_.hidden;
  handles_.assign(hidden.empty() ? 0 : state_.bead_count(), no_handles);
  displaced_.clear();
  if (hidden.empty()) return;
  for (const BeadId bead : hidden.beads()) {
    if (hidden.host(bead) == no_cell) {
      displaced_.push_back(bead);
    } else {
      enqueue(bead);
    }
  }
  const auto take = [this](BeadId bead, int i, CertificateHandle handle) {
    handles_[bead][static_cast<std::size_t>(i)] = handle;
    if (handle == CertificateHandle::violated) displaced_.push_back(bead);
  };
  departures_.watch_enqueued(
      [&](FacetId place, CertificateHandle handle) { take(cell_of(place), index_of(place), handle); });
  appearances_.watch_enqueued(
      [&](BeadId bead, CertificateHandle handle) { take(bead, Dimension + 1, handle); });
  std::sort(displaced_.begin(), displaced_.end());
  displaced_.erase(std::unique(displaced_.begin(), displaced_.end()), displaced_.end());
  for (const BeadId bead : displaced_) drop(bead);
  rehouse(state_.some_finite_cell());
}

template <int Dimension>
void HiddenCertificates<Dimension>::displace(std::span<const CellId> cells) {
  displaced_.clear();
  if (state_.hidden.empty()) return;
  for (const CellId cell : cells) state_.hidden.empty_out(cell, displaced_);
  for (const BeadId bead : displaced_) drop(bead);
  std::sort(displaced_.begin(), displaced_.end());
}

template <int Dimension>
void HiddenCertificates<Dimension>::add_displaced(BeadId bead) {
  displaced_.insert(std::upper_bound(displaced_.begin(), displaced_.end(), bead), bead);
}

template <int Dimension>
void HiddenCertificates<Dimension>::rehouse(CellId near) {
  if (displaced_.empty()) return;
  HiddenBeads& hidden = state_.hidden;
  for (const BeadId bead : displaced_) {
    const CellId from = hidden.host(bead) == no_cell ? near : hidden.host(bead);
    const CellId host = find_host(bead, from);
    if (host == no_cell) {
      state_.suspect(Doubt::wrong);
      continue;
    }
    hidden.enter(bead, host);
    enqueue(bead);
  }
  displaced_.clear();
  watch_enqueued();
}

template <int Dimension>
CellId HiddenCertificates<Dimension>::walk_to(BeadId bead, CellId cell, int came_from) {
  if (state_.is_infinite(cell)) {
    cell = state_.neighbor(cell, state_.vertex_index(cell, infinite_bead));
    came_from = -1;
  }
  const std::size_t most_steps = state_.triangulation.cells().size();
  for (std::size_t step = 0; step <= most_steps; ++step) {
    if (state_.is_infinite(cell)) return cell;
    const Beads& v = state_.beads_of(cell);
    int leaves_by = -1;
    for (int i = 0; i <= Dimension && leaves_by < 0; ++i) {
      if (i != came_from && state_.sign_just_after(Orientation<Dimension>(State::with(v, i, bead), 1)) < 0)
        leaves_by = i;
    }
    if (leaves_by < 0) return cell;
    std::tie(cell, came_from) = state_.across(cell, leaves_by);
  }
  return no_cell;
}

/// Returns the host of a bead just after now, or no_cell if none is found. If the bead lies on a face shared
/// by several cells, the host is the one of these cells with the least beads, wherever the walk started. Flat
/// cells are passed through, because all beads of their plane seem to lie in them.
template <int Dimension>
CellId HiddenCertificates<Dimension>::find_host(BeadId bead, CellId cell, int came_from) {
  const CellId at = walk_to(bead, cell, came_from);
  if (at == no_cell || state_.is_infinite(at)) return no_cell;
  std::vector<CellId> around{at};
  CellId least = no_cell;
  Beads least_beads{};
  for (std::size_t next = 0; next < around.size(); ++next) {
    Beads v = state_.beads_of(around[next]);
    std::array<int, Dimension + 1> signs;
    for (int i = 0; i <= Dimension; ++i)
      signs[static_cast<std::size_t>(i)] =
          state_.sign_just_after(Orientation<Dimension>(State::with(v, i, bead), 1));
    const auto [smallest, largest] = std::minmax_element(signs.begin(), signs.end());
    if (*smallest < 0) continue;  // the bead lies in the plane of the face, but beside the cell
    for (int i = 0; i <= Dimension; ++i) {
      if (signs[static_cast<std::size_t>(i)] != 0) continue;
      const CellId beyond = state_.neighbor(around[next], i);
      if (!state_.is_infinite(beyond) && std::find(around.begin(), around.end(), beyond) == around.end())
        around.push_back(beyond);
    }
    if (*largest == 0) continue;  // a flat cell
    std::sort(v.begin(), v.end());
    if (least == no_cell || v < least_beads) {
      least = around[next];
      least_beads = v;
    }
  }
  return least == no_cell ? at : least;
}

template <int Dimension>
void HiddenCertificates<Dimension>::wander(BeadId bead, int facet) {
  const auto [beyond, came_from] = state_.across(state_.hidden.host(bead), facet);
  drop(bead);
  const CellId host = find_host(bead, beyond, came_from);
  if (host == no_cell) return state_.suspect(Doubt::wrong);
  Change change{Events::wanders, Dimension + 2, {bead}};
  const Beads& v = state_.beads_of(host);
  std::copy(v.begin(), v.end(), change.ids.begin() + 1);
  std::sort(change.ids.begin() + 1, change.ids.begin() + Dimension + 2);
  state_.record(change);
  enter(bead, host);
}

template <int Dimension>
auto HiddenCertificates<Dimension>::take_failure(unsigned table, std::uint32_t slot)
    -> std::optional<Failed> {
  Failed failed;
  if (table == appearing) {
    failed = {appearances_.place_in_structure(slot), std::nullopt, appearances_.identity(slot)};
    handles_[failed.bead].back() = CertificateHandle::violated;
  } else {
    const FacetId place = departures_.place_in_structure(slot);
    failed = {cell_of(place), index_of(place), departures_.identity(slot)};
    handles_[failed.bead][static_cast<std::size_t>(index_of(place))] = CertificateHandle::violated;
  }
  if (state_.doubt != Doubt::wrong) return failed;
  // This failure is not handled where it occurs, so a repair of other cells would not suffice.
  state_.suspect(Doubt::wrong);
  return std::nullopt;
}

template class HiddenCertificates<2>;
template class HiddenCertificates<3>;

}  // namespace kds
