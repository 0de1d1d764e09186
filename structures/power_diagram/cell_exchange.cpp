#include "structures/power_diagram/cell_exchange.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "structures/power_diagram/diagram_state.h"

namespace kds {

namespace {

/// Names a facet together with one of its sides: two cells with this facet have equal values if they lie on
/// the same side. `v` must be positively oriented.
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

/// Returns the beads of a cell in ascending order, except that the last two are exchanged if this is needed
/// to keep the cell's orientation.
template <std::size_t N>
std::array<BeadId, N> in_order(std::array<BeadId, N> cell) {
  if (sort_beads(cell) < 0) std::swap(cell[N - 2], cell[N - 1]);
  return cell;
}

/// Calls `visit(cell, i)` for each facet that bounds the region of the given cells, as a facet of the inner
/// cell.
template <int Dimension, class Visit>
void for_facets_around(const DiagramState<Dimension>& state, std::span<const CellId> cells, Visit visit) {
  std::vector<CellId> inside(cells.begin(), cells.end());
  std::sort(inside.begin(), inside.end());
  for (const CellId cell : cells) {
    for (int i = 0; i <= Dimension; ++i) {
      if (!std::binary_search(inside.begin(), inside.end(), state.neighbor(cell, i))) visit(cell, i);
    }
  }
}

}  // namespace

template <int Dimension>
auto CellExchange<Dimension>::fill_of(std::span<const CellId> hole, std::vector<BeadId> beads,
                                      const Dyadic& time) const -> std::vector<Beads> {
  using Side = FacetSide<Dimension + 1>;
  std::sort(beads.begin(), beads.end());
  beads.erase(std::unique(beads.begin(), beads.end()), beads.end());
  const auto built = static_diagram(state_, std::span<const BeadId>(beads), time, true);
  std::map<Side, std::size_t> cell_on;
  for (std::size_t c = 0; c < built.cells.size(); ++c) {
    for (std::size_t i = 0; i <= Dimension; ++i) cell_on.emplace(Side(built.cells[c], i), c);
  }
  std::vector<Side> open;
  for_facets_around(state_, hole, [&](CellId cell, int i) {
    open.emplace_back(state_.beads_of(cell), static_cast<std::size_t>(i));
  });
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
    for (std::size_t i = 0; i <= Dimension; ++i) {
      const Side side(v, i);
      if (!std::binary_search(around.begin(), around.end(), side)) open.push_back(side.beyond());
    }
  }
  return made;
}
template <int Dimension>
bool CellExchange<Dimension>::can_fill(std::span<const CellId> hole, std::span<const Beads> made) {
  return state_.triangulation.fits(hole, made) &&
         std::all_of(made.begin(), made.end(), [this](const Beads& cell) {
           const Orientation<Dimension> orientation(cell, 1);
           return orientation.beads.back() == infinite_bead || state_.sign_just_after(orientation) > 0;
         });
}
template <int Dimension>
bool CellExchange<Dimension>::is_regular(std::span<const CellId> hole, std::span<const Beads> made) {
  using Side = FacetSide<Dimension + 1>;
  std::map<Side, std::pair<Beads, BeadId>> beyond;  // facet side -> the cell there and its bead off the facet
  for_facets_around(state_, hole, [&](CellId cell, int i) {
    const auto [other, k] = state_.across(cell, i);
    beyond.emplace(Side(state_.beads_of(other), static_cast<std::size_t>(k)),
                   std::pair(state_.beads_of(other), state_.vertex(other, k)));
  });
  for (const Beads& cell : made) {
    for (std::size_t i = 0; i <= Dimension; ++i) {
      const auto there = beyond.find(Side(cell, i).beyond());
      if (there == beyond.end()) {
        beyond.emplace(Side(cell, i), std::pair(cell, cell[i]));
      } else if (!state_.is_regular_just_after(cell, there->second.first, there->second.second)) {
        return false;
      }
    }
  }
  return true;
}

template <int Dimension>
void CellExchange<Dimension>::fill(std::span<const CellId> hole, std::span<const Beads> made) {
  facets_.drop_around(hole);
  std::vector<Beads> gone;
  for (const CellId cell : hole) gone.push_back(state_.beads_of(cell));
  const std::vector<CellId> cells = exchange(hole, record(gone, made));
  facets_.watch_around(cells);
  hidden_.rehouse(cells[0]);
}

template <int Dimension>
auto CellExchange<Dimension>::record(std::span<const Beads> gone, std::span<const Beads> made)
    -> std::vector<Beads> {
  std::vector<Beads> cleared(gone.begin(), gone.end()), filled;
  for (Beads& cell : cleared) std::sort(cell.begin(), cell.end());
  for (const Beads& cell : made) filled.push_back(in_order(cell));
  for (auto* cells : {&cleared, &filled}) {
    std::sort(cells->begin(), cells->end());
    for (const Beads& cell : *cells) {
      Change change{cells == &cleared ? Events::clears : Events::fills, Dimension + 1, {}};
      std::copy(cell.begin(), cell.end(), change.ids.begin());
      state_.record(change);
    }
  }
  return filled;
}

template <int Dimension>
std::vector<CellId> CellExchange<Dimension>::exchange(std::span<const CellId> hole,
                                                      std::span<const Beads> made) {
  std::vector<BeadId> before;
  for (const CellId cell : hole) {
    const Beads& v = state_.beads_of(cell);
    before.insert(before.end(), v.begin(), v.end());
  }
  std::sort(before.begin(), before.end());
  before.erase(std::unique(before.begin(), before.end()), before.end());
  std::vector<CellId> cells = state_.triangulation.replace(hole, made);
  for (const BeadId b : before) {
    if (state_.is_absent(b) || state_.triangulation.is_vertex(b)) continue;
    hidden_.hide(b);
    hidden_.add_displaced(b);
  }
  for (const Beads& cell : made) {
    for (const BeadId b : cell) {
      if (b == infinite_bead || !state_.hidden.contains(b)) continue;
      state_.hidden.show(b);
      hidden_.remove_displaced(b);
    }
  }
  return cells;
}

template class CellExchange<2>;
template class CellExchange<3>;

}  // namespace kds
