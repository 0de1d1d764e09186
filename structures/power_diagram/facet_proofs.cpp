#include "structures/power_diagram/facet_proofs.h"

#include <utility>

#include "motions/base/grow_little.h"

namespace kds {

namespace {

/// Least share of beads that go straight on. Lookahead skips a facet only if all of its four or five beads do
/// so. With a smaller share looking ahead costs more than it saves.
constexpr double worth_a_look = 0.7;
constexpr int steps_in_mean = 8;

}  // namespace

template <int Dimension>
void FacetLookahead<Dimension>::start_step(const Curves<Dimension>& curves,
                                           const Triangulation& triangulation) {
  ++step_;
  const bool was_used = used_;
  if (used_) {
    ahead_.look_at(curves);
  } else {
    ahead_.look_at_some(curves);
  }
  in_mean_ = std::min(in_mean_ + 1, steps_in_mean);
  share_straight_ += (ahead_.share_straight() - share_straight_) / in_mean_;
  used_ = share_straight_ >= worth_a_look;
  if (!used_) return;
  const std::size_t cells = triangulation.cells().size();
  if (was_used) return grow(cells);
  ahead_.look_at(curves);
  until_.assign(cells, Until{} + at_other_cell);
  positive_until_.assign(cells, nothing_known);
  for (CellId cell = 0; cell < cells; ++cell)
    for (int i = 0; i <= Dimension; ++i)
      if (triangulation.is_live(cell) && cell < cell_of(triangulation.beyond(cell, i)))
        until_[cell][i] = nothing_known;
}

template <int Dimension>
void FacetLookahead<Dimension>::forget_all() {
  used_ = false;
  in_mean_ = 0;
}

template <int Dimension>
FacetProofs<Dimension>::FacetProofs(State& state)
    : state_(state),
      filter_(cell_filter_over(state.motion)),
      filter_ahead_(cell_filter_over<Dimension>(lookahead_.ahead(), FilterOf::parts)) {}

template <int Dimension>
void FacetProofs<Dimension>::start_step(bool all_move) {
  // Slack is computed as if weights were constant.
  const bool keeps_facts =
      state_.simulator.kernel() != Kernel::exact && !state_.motion.is_lifted() && all_move;
  if (keeps_facts) slack_.start_step(state_.curves, state_.triangulation);
  if (keeps_facts && state_.motion.degree() == 1 && !slack_.any()) {
    lookahead_.start_step(state_.curves, state_.triangulation);
  } else {
    lookahead_.forget_all();
  }
  ends_positive_.clear();
}

template <int Dimension>
void FacetProofs<Dimension>::start_facets(bool all_move) {
  ends_positive_.assign(all_move ? state_.triangulation.cells().size() : 0, 0);
  unit_ = LengthUnit(exponent_of_length(state_.curves, state_.triangulation.cells()));
}

template <int Dimension>
void FacetProofs<Dimension>::forget_all() {
  slack_.forget_all();
  lookahead_.forget_all();
  ends_positive_.clear();
}

template <int Dimension>
std::span<const FacetId> FacetProofs<Dimension>::hull_not_proved_ahead() {
  std::size_t doubts = 0;
  for (std::size_t first = 0; first < on_hull_.size(); first += cells_in_batch) {
    const std::size_t count = std::min(cells_in_batch, on_hull_.size() - first);
    CellsInLanes<Dimension> beads;
    for (std::size_t lane = 0; lane < cells_in_batch; ++lane) {
      const FacetId facet = on_hull_[first + (lane < count ? lane : 0)];
      Orientation<Dimension> orientation;
      CellCertificates(state_.beads_of(cell_of(facet)))
          .make(state_.apex(cell_of(facet), index_of(facet)), orientation);
      std::copy(orientation.beads.begin(), orientation.beads.end(), beads[lane].begin());
      if (!orientation.side()) std::swap(beads[lane][0], beads[lane][1]);
    }
    PositiveBits positive;
    filter_ahead_->positive_cells(beads, 0, unit_, positive);
    for (std::size_t lane = 0; lane < count; ++lane) {
      const FacetId facet = on_hull_[first + lane];
      int part = 0;
      while (part <= positive_parts &&
             (positive[lane] >> (part * bits_of_part) & positive_throughout<Dimension>) == 0)
        ++part;
      if (part > positive_parts) {
        on_hull_[doubts++] = facet;  // overwrites a facet that this loop has read
      } else {
        lookahead_.proved(cell_of(facet), index_of(facet),
                          static_cast<int>(MotionAhead<Dimension>::steps) >> part);
      }
    }
  }
  return std::span(on_hull_).first(doubts);
}

template <int Dimension>
auto FacetProofs<Dimension>::found_around(std::span<const CellId> cells) -> std::array<unsigned, few_cells> {
  std::array<unsigned, few_cells> found{};
  const bool ahead = looks_ahead();
  if (state_.simulator.kernel() != Kernel::exact)
    found = filter_few_cells(ahead ? *filter_ahead_ : *filter_, unit_, state_.triangulation.cells(), cells);
  grow_little(ends_positive_, state_.triangulation.cells().size());
  const unsigned is_positive = ahead ? positive_throughout<Dimension> : positive_at_end<Dimension>;
  for (std::size_t c = 0; c < cells.size(); ++c)
    ends_positive_[cells[c]] = (in_some_part(found[c]) & is_positive) != 0 ? 1 : 0;
  return found;
}

template class FacetLookahead<2>;
template class FacetLookahead<3>;
template class FacetProofs<2>;
template class FacetProofs<3>;

}  // namespace kds
