#include "structures/power_diagram/facet_foresight.h"

namespace kds {

namespace {

/// Least share of beads that go straight on. A facet rests only if all of its four or five beads do, so with
/// a smaller share looking ahead costs more than it saves.
constexpr double worth_a_look = 0.7;
constexpr int steps_in_mean = 8;

}  // namespace

template <int Dimension>
void FacetForesight<Dimension>::start_step(const Curves<Dimension>& curves,
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
void FacetForesight<Dimension>::forget_all() {
  used_ = false;
  in_mean_ = 0;
}

template class FacetForesight<2>;
template class FacetForesight<3>;

}  // namespace kds
