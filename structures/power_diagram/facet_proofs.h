#pragma once
// Proofs that facets of a power diagram hold without a certificate. There are three kinds: slack, a distance
// (facet_slack.h); lookahead, which has proved some steps ahead (FacetLookahead); and a filter, floating
// point with a proved bound, for the whole step (facet_filter.h). The step skips facets that slack or
// lookahead proves. Facets that no proof covers are in doubt and get certificates (facet_certificates.h).

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "certificates/filters/cell_filter.h"
#include "motions/views/lanes_view.h"
#include "motions/views/motion_ahead.h"
#include "structures/power_diagram/diagram_state.h"
#include "structures/power_diagram/facet_filter.h"
#include "structures/power_diagram/facet_slack.h"
#include "structures/triangulation/regular_triangulation.h"

namespace kds {

/// Facets that are known to hold for some steps ahead, provided that all their beads go straight on
/// (motion_ahead.h). The following steps skip such facets while this condition holds. Likewise, cells can be
/// known to stay positive. One of the two cells of each facet stores until which step the facet holds. At the
/// start of a step, one branch-free pass over all cells determines which of their beads have turned and which
/// facets must be examined.
///
/// If too many beads turn from step to step, looking ahead is switched off, and only a few beads are watched.
template <int Dimension>
class FacetLookahead {
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
  /// Forgets what is known of a facet whose beads change: facet i of `cell`, which is facet k of `other`. The
  /// beads of `cell` may change too.
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

/// Finds in a step the facets that hold without a certificate.
template <int Dimension>
class FacetProofs {
  using State = DiagramState<Dimension>;

 public:
  explicit FacetProofs(State& state);

  /// Called at the start of a step. Facts from earlier steps are used only if all beads move.
  void start_step(bool all_move);
  /// Called when the certificates of the facets are about to be created.
  void start_facets(bool all_move);
  /// Discards all that is known of cells and facets.
  void forget_all();
  /// Called when beads are about to get other curves.
  void forget_courses() { lookahead_.forget_all(); }

  /// Returns whether slack decides which facets are skipped.
  [[nodiscard]] bool has_slack() const { return slack_.any(); }
  /// Numbers of facets that hold without a certificate.
  struct Proved {
    std::uint64_t skipped = 0;   ///< by slack, or by lookahead
    std::uint64_t positive = 0;  ///< positive over the whole step
  };
  /// Calls doubt(cell, i) for all facets that are not proved to hold. Unless has_slack(), calls note(cell)
  /// for all live cells before. Without `in_lanes` no filter is used.
  template <bool in_lanes, class Note, class Doubt>
  Proved prove_all(const Note& note, const Doubt& doubt) {
    const auto found = taking_doubts(doubt);
    FacetFilter<Dimension> positive(*filter_, unit_);
    const auto& triangulation = state_.triangulation;
    const auto cells = triangulation.cells();
    const auto look_at = [&](CellId cell, unsigned facets, unsigned finite) {
      if constexpr (in_lanes)
        if (finite != 0) positive.look_at(cells[cell], cell, facets & finite, found);
      for (unsigned left = facets & ~finite; left != 0; left &= left - 1) doubt(cell, std::countr_zero(left));
    };
    const auto finite_of = [&](CellId cell) { return in_lanes ? finite_facets(cells[cell]) : 0; };
    Proved proved;
    if (lookahead_.any()) {
      proved.skipped = facet_count() - prove_ahead(positive, note, doubt);
    } else if (slack_.any()) {
      std::uint64_t others = 0;
      slack_.for_the_others(triangulation, [&](CellId cell, unsigned facets) {
        others += count_of<Dimension>(facets);
        look_at(cell, facets, finite_of(cell));
      });
      proved.skipped = facet_count() - others;
    } else {
      constexpr std::size_t ahead = 12;
      cover_.start(cells.size());
      for (CellId cell = 0; cell < cells.size(); ++cell) {
        if (!triangulation.is_live(cell)) continue;
        __builtin_prefetch(&cells[cell] + ahead);
        note(cell);
        const unsigned finite = finite_of(cell);
        look_at(cell, cover_.facets_of(cells[cell], cell, finite == all_facets<Dimension>), finite);
      }
    }
    if constexpr (in_lanes) positive.finish(found);
    proved.positive = positive.count();
    return proved;
  }

  /// Returns what the filters find for each of at most four new cells: the facets whose power test is
  /// positive over the whole step, which most facets to older cells are. If looking ahead pays, also those
  /// whose power test is positive over some steps ahead.
  [[nodiscard]] std::array<unsigned, few_cells> found_around(std::span<const CellId> cells);
  /// Stores what found_around has found for these facets of a cell.
  void proved_around(CellId cell, unsigned facets, unsigned found) {
    if (looks_ahead()) lookahead_.proved(cell, facets, found);
  }
  /// Forgets what is known of a facet whose beads change: facet i of `cell`, which is facet k of `other`. The
  /// beads of `cell` may change too.
  void forget(CellId cell, int i, CellId other, int k) {
    slack_.forget(cell, i);
    slack_.forget(other, k);
    lookahead_.forget(cell, i, other, k);
  }

  /// Returns for each cell whether it is known to be positive at the end of the step. The span may be shorter
  /// than the list of cells, or empty.
  [[nodiscard]] std::span<const std::uint8_t> known_positive_at_end() const { return ends_positive_; }
  void forget_ends() { ends_positive_.clear(); }

 private:
  [[nodiscard]] std::uint64_t facet_count() const {
    return state_.triangulation.live_count() * (Dimension + 1) / 2;
  }
  /// Returns whether facets are searched for some steps ahead: only if all beads are known ahead.
  [[nodiscard]] bool looks_ahead() const { return lookahead_.any() && lookahead_.ahead().all_known(); }

  /// Takes what a filter finds: facets not found positive are in doubt.
  template <class Doubt>
  [[nodiscard]] auto taking_doubts(const Doubt& doubt) {
    return [this, &doubt](CellId cell, unsigned wanted, unsigned positive) {
      for (unsigned doubts = wanted & ~positive; doubts != 0; doubts &= doubts - 1)
        doubt(cell, std::countr_zero(doubts));
      ends_positive_[cell] = (positive & positive_at_end<Dimension>) != 0 ? 1 : 0;
    };
  }
  /// Looks ahead for facets not known from previous steps, and examines the remaining ones for this step
  /// only. Returns the number of facets not proved by lookahead.
  template <class Note, class Doubt>
  std::uint64_t prove_ahead(FacetFilter<Dimension>& positive, const Note& note, const Doubt& doubt) {
    const auto& triangulation = state_.triangulation;
    const auto cells = triangulation.cells();
    std::uint64_t others = 0;
    const auto found = taking_doubts(doubt);
    const bool all_known = lookahead_.ahead().all_known();
    const auto found_ahead = [&](CellId cell, unsigned wanted, unsigned positive_parts_of_step) {
      lookahead_.proved(cell, wanted, positive_parts_of_step);
      unsigned doubts = wanted & ~in_some_part(positive_parts_of_step);
      if (doubts == 0) return;
      others += count_of<Dimension>(doubts);
      if (!all_known) return positive.look_at(cells[cell], cell, doubts, found);
      for (; doubts != 0; doubts &= doubts - 1) doubt(cell, std::countr_zero(doubts));
    };
    FacetFilter<Dimension> ahead(*filter_ahead_, unit_);
    on_hull_.clear();
    lookahead_.for_the_others(triangulation, note, [&](CellId cell, unsigned facets) {
      const unsigned finite = finite_facets(cells[cell]);
      for (unsigned left = facets & ~finite; left != 0; left &= left - 1)
        on_hull_.push_back(facet_id(cell, std::countr_zero(left)));
      if (finite == 0 && state_.is_infinite(cell)) {
        lookahead_.stays_positive_ahead(cell);
      } else {
        ahead.look_at(cells[cell], cell, facets & finite, found_ahead);
      }
    });
    ahead.finish(found_ahead);
    for (const FacetId facet : hull_not_proved_ahead()) {
      ++others;
      doubt(cell_of(facet), index_of(facet));
    }
    for (CellId cell = 0; cell < ends_positive_.size(); ++cell)
      if (lookahead_.stays_positive(cell)) ends_positive_[cell] = 1;
    return others;
  }
  /// Looks ahead for the facets on_hull_. An orientation guards each of these facets, as it guards a cell.
  /// Returns those not found to hold.
  [[nodiscard]] std::span<const FacetId> hull_not_proved_ahead();

  State& state_;
  std::unique_ptr<CellFilter<Dimension>> filter_;
  FacetCover cover_;
  LengthUnit unit_;  // close to the cells' lengths in this step
  std::vector<std::uint8_t> ends_positive_;
  FacetSlack<Dimension> slack_;
  FacetLookahead<Dimension> lookahead_;
  std::unique_ptr<CellFilter<Dimension>> filter_ahead_;
  std::vector<FacetId> on_hull_;  // facets of the hull to be examined ahead
};

extern template class FacetLookahead<2>;
extern template class FacetLookahead<3>;
extern template class FacetProofs<2>;
extern template class FacetProofs<3>;

}  // namespace kds
