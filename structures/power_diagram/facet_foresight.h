#pragma once
// Facets that are known to hold for some steps ahead, provided that all their beads go straight on
// (motion_ahead.h). Such facets rest while this condition holds: the following steps skip them. Likewise,
// cells can be known to stay positive. One of the two cells of each facet stores until which step the facet
// holds. At the start of a step, one branch-free pass over all cells determines which of their beads have
// turned and which facets must be examined.
//
// If too many beads turn from step to step, looking ahead is switched off, and only a few beads are watched.

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "certificates/filters/cell_filter.h"
#include "motions/views/motion_ahead.h"
#include "structures/triangulation/regular_triangulation.h"

namespace kds {

template <int Dimension>
class FacetForesight {
 public:
  using Triangulation = RegularTriangulation<Dimension>;

  /// Called at the start of a step of a linear motion.
  void start_step(const Curves<Dimension>& curves, const Triangulation& triangulation);
  /// Returns whether looking ahead pays in this step.
  [[nodiscard]] bool any() const { return used_; }
  [[nodiscard]] const MotionAhead<Dimension>& ahead() const { return ahead_; }

  /// Calls `each(cell)` for all cells. Then calls `visit(cell, facets)` for live cells with the set of facets
  /// to be examined, one bit each; each facet is reported at one of its cells. Also calls `visit` with an
  /// empty set if the cell itself is not known to stay positive. Must be called at the start of the step;
  /// afterwards `proved` must be called with what is known of these cells from now on.
  template <class Each, class Visit>
  void for_the_others(const Triangulation& triangulation, Each each, Visit visit) {
    const auto cells = triangulation.cells();
    others_.resize(cells.size());
    std::size_t count = 0;
    for (CellId id = 0; id < cells.size(); ++id) {
      each(id);
      others_[count] = others_of(cells[id], id);
      // Branch-free, because the outcome is unpredictable.
      count += (others_[count].facets != 0 ? 1U : 0U) | (positive_until_[id] <= step_ ? 1U : 0U);
    }
    for (std::size_t n = 0; n < count; ++n) {
      const auto [id, facets] = others_[n];
      if (triangulation.is_live(id)) visit(id, facets);
    }
  }
  /// Stores what a filter with parts finds for a cell from the start of this step (PositiveBits, one bit for
  /// each facet). Facets in the set that are not found positive are examined again in the next step.
  void proved(CellId cell, unsigned facets, unsigned found) {
    Until steps{};
    std::int32_t cell_steps = 0;
    for (int part = positive_parts; part >= 0; --part) {
      const auto in_part = static_cast<std::int32_t>(found >> (part * bits_of_part));
      const Until hold = Until{} + (in_part & static_cast<std::int32_t>(facets));
      steps = (hold & Until{1, 2, 4, 8}) != 0 ? Until{} + (all_steps >> part) : steps;
      cell_steps = (in_part & static_cast<std::int32_t>(positive_throughout<Dimension>)) != 0
                       ? all_steps >> part
                       : cell_steps;
    }
    until_[cell] = steps != 0 ? steps + step_ : until_[cell];
    positive_until_[cell] = cell_steps != 0 ? step_ + cell_steps : positive_until_[cell];
  }
  /// Stores that one facet holds for `steps` steps.
  void proved(CellId cell, int i, int steps) { until_[cell][i] = step_ + steps; }
  /// Stores that the cell stays positive, for cells that cannot become anything else.
  void stays_positive_ahead(CellId cell) { positive_until_[cell] = step_ + all_steps; }
  /// Notes that the facet, facet i of this cell and facet k of the other, has other beads, and that the cell
  /// may have others too.
  void forget(CellId cell, int i, CellId other, int k) {
    if (!used_) return;
    grow(std::max(cell, other) + 1);
    until_[cell][i] = nothing_known;
    until_[other][k] = at_other_cell;
    positive_until_[cell] = nothing_known;
  }
  /// Returns whether a cell is known to stay positive in this step.
  [[nodiscard]] bool stays_positive(CellId cell) const {
    return used_ && cell < positive_until_.size() && positive_until_[cell] > step_;
  }
  /// Discards all knowledge and switches looking ahead off for this step.
  void forget_all();

 private:
  /// For each facet of a cell, the first step in which it must be examined again.
  using Until = std::int32_t __attribute__((vector_size(16)));
  /// A step before all others, because steps are counted from 1.
  static constexpr std::int32_t nothing_known = 0;
  static constexpr std::int32_t all_steps = MotionAhead<Dimension>::steps;
  static_assert(all_steps >> positive_parts == 1);
  static constexpr std::int32_t at_other_cell = std::numeric_limits<std::int32_t>::max();

  /// Makes room for new cells. All facets of new cells are passed to `forget` before they are read.
  void grow(std::size_t cells) {
    if (cells <= until_.size()) return;
    until_.resize(cells + cells / 8, Until{} + at_other_cell);
    positive_until_.resize(until_.size(), nothing_known);
  }
  /// The facets of a cell that must be examined there, one bit each.
  struct Others {
    CellId cell;
    unsigned facets;
  };
  /// First discards the knowledge that became invalid because beads of the cell turned.
  [[nodiscard, gnu::always_inline]] Others others_of(const TriangulationCell<Dimension>& cell, CellId id) {
    std::int32_t in_cell = 0;
    Until beyond{};
    for (std::size_t i = 0; i <= Dimension; ++i) {
      in_cell |= ahead_.turned(cell.vertex[i]);
      beyond[i] = ahead_.turned(cell.apex[i]);
    }
    Until until = until_[id];
    until &= ~((beyond | in_cell) & (until != at_other_cell));
    until_[id] = until;
    positive_until_[id] &= ~in_cell;
    const Until bits = (until <= step_) & Until{1, 2, 4, 8};
    return {id, static_cast<unsigned>(bits[0] | bits[1] | bits[2] | bits[3])};
  }

  MotionAhead<Dimension> ahead_;
  bool used_ = false;
  double share_straight_ = 0;  ///< share of the beads that go straight on, averaged over some steps
  int in_mean_ = 0;
  std::int32_t step_ = 1;
  std::vector<Until> until_;
  std::vector<std::int32_t> positive_until_;  ///< for each cell: first step not covered
  std::vector<Others> others_;
};

extern template class FacetForesight<2>;
extern template class FacetForesight<3>;

}  // namespace kds
