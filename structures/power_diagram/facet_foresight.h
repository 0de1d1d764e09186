#pragma once
// Facets that are known to hold for some steps ahead if all their beads go straight on (motion_ahead.h), and
// rest for as long as these do: in the steps that follow they are not looked at. So it is with cells, which
// are known to stay positive. Of each facet one of its two cells keeps until when. Where a step starts all
// cells are asked at once, without a branch, which of their beads have turned, and what has to be looked at.
//
// Where too many beads turn from step to step nothing is looked at ahead, and only a few beads are watched.

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

  /// At the start of a step of a linear motion.
  void start_step(const Curves<Dimension>& curves, const Triangulation& triangulation);
  /// Whether it pays to look ahead in this step.
  [[nodiscard]] bool any() const { return used_; }
  [[nodiscard]] const MotionAhead<Dimension>& ahead() const { return ahead_; }

  /// Calls `each(cell)` with all cells, and `visit(cell, facets)` with all facets of live cells that are to
  /// be looked at, one bit each, each at one of its cells; also with no facets where the cell itself is not
  /// known to stay positive. Asked at the start of the step, and then `proved` is told what is known of the
  /// cell from now on.
  template <class Each, class Visit>
  void for_the_others(const Triangulation& triangulation, Each each, Visit visit) {
    const auto cells = triangulation.cells();
    others_.resize(cells.size());
    std::size_t count = 0;
    for (CellId id = 0; id < cells.size(); ++id) {
      each(id);
      others_[count] = others_of(cells[id], id);
      // No branch: no one foretells which.
      count += (others_[count].facets != 0 ? 1U : 0U) | (positive_until_[id] <= step_ ? 1U : 0U);
    }
    for (std::size_t n = 0; n < count; ++n) {
      const auto [id, facets] = others_[n];
      if (triangulation.is_live(id)) visit(id, facets);
    }
  }
  /// What a filter of parts finds of a cell (PositiveBits, one bit for each facet) from this step's start on.
  /// These facets, if they are not found positive, are looked at again in the next step.
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
  /// One facet holds for that many steps.
  void proved(CellId cell, int i, int steps) { until_[cell][i] = step_ + steps; }
  /// It cannot be anything else.
  void stays_positive_ahead(CellId cell) { positive_until_[cell] = step_ + all_steps; }
  /// The facet, as this cell and the other have it, has got other beads, and so may this cell have.
  void forget(CellId cell, int i, CellId other, int k) {
    if (!used_) return;
    grow(std::max(cell, other) + 1);
    until_[cell][i] = nothing_known;
    until_[other][k] = at_other_cell;
    positive_until_[cell] = nothing_known;
  }
  /// Whether a cell is known to stay positive in this step.
  [[nodiscard]] bool stays_positive(CellId cell) const {
    return used_ && cell < positive_until_.size() && positive_until_[cell] > step_;
  }
  /// Nothing is known, and in this step nothing more is looked at ahead.
  void forget_all();

 private:
  /// Of each facet of a cell the first step in which it is to be looked at again.
  using Until = std::int32_t __attribute__((vector_size(16)));
  /// Steps are counted from 1.
  static constexpr std::int32_t nothing_known = 0;
  static constexpr std::int32_t all_steps = MotionAhead<Dimension>::steps;
  static_assert(all_steps >> positive_parts == 1);
  static constexpr std::int32_t at_other_cell = std::numeric_limits<std::int32_t>::max();

  /// Facets of new cells are forgotten before they are asked for.
  void grow(std::size_t cells) {
    if (cells <= until_.size()) return;
    until_.resize(cells + cells / 8, Until{} + at_other_cell);
    positive_until_.resize(until_.size(), nothing_known);
  }
  /// Facets of a cell that are to be looked at there, one bit each.
  struct Others {
    CellId cell;
    unsigned facets;
  };
  /// Once what its beads end by turning is forgotten.
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
  double share_straight_ = 0;  ///< of the beads, a mean of some steps
  int in_mean_ = 0;
  std::int32_t step_ = 1;
  std::vector<Until> until_;
  std::vector<std::int32_t> positive_until_;  ///< of each cell
  std::vector<Others> others_;
};

extern template class FacetForesight<2>;
extern template class FacetForesight<3>;

}  // namespace kds
