#pragma once
// Where flips do not suffice: simultaneous events that block each other, cells that turn over unseen, frames
// where beads coincide or all lie in one plane. Then the diagram is built anew, by CGAL with exact numbers,
// at a time after the present one so near that nothing is skipped, and the rebuild is counted. Where it is
// known which cells are wrong and these are few, only they and perhaps some around them are.

#include <vector>

#include "certificates/exact/exact_time.h"
#include "structures/power_diagram/cell_exchange.h"
#include "structures/power_diagram/facet_guards.h"
#include "structures/power_diagram/hidden_guards.h"

namespace kds {

template <int Dimension>
class DiagramRebuilder {
  using State = DiagramState<Dimension>;
  using Events = typename State::Events;
  using Beads = typename State::Beads;

 public:
  DiagramRebuilder(State& state, FacetGuards<Dimension>& facets, HiddenGuards<Dimension>& hidden)
      : state_(state), facets_(facets), hidden_(hidden), exchange_(state, facets, hidden) {}

  /// From the k-th control points, an end of the step.
  void build_from_control_points(int k);
  /// As CGAL does it at the end of the step; the mirror is made when a step starts.
  void build_bare_at_end();
  /// Rebuilds are counted anew.
  void start_step();
  /// Guards facets and hidden beads, all of them.
  void watch_all();
  /// If the diagram is wrong just after the events of one time, it is built anew.
  void after_batch();
  /// False, and no cells, where all beads stay in one plane or on one line.
  [[nodiscard]] bool try_to_rebuild();
  /// Rebuilds at the first time on ever finer grids after now before which nothing fails.
  void rebuild_at_first_time_that_works();
  /// That no cells can be built in a step.
  [[noreturn]] static void refuse_flat(std::size_t step);
  /// Makes a logged rebuild again, without certificates. Throws std::invalid_argument if it cannot be made.
  void apply(const Change& change);
  /// Makes a rebuild again whose cells are in the log, positively oriented, infinite ones included.
  void assign_logged(std::span<const Beads> cells);

 private:
  // Binary places of a rebuild's time. Up to the finest logged grid a log holds the time, whose numerator
  // fits into a Change. Beyond that grid a log holds all cells that go and come, and the number of places
  // doubles up to the finest grid.
  // The finest grid suffices for doubles of all exponents (2^-1074 to 2^1024): roots can be 2^-2098 of a
  // step apart in lengths, and 2^-10490 in power tests, which have degree 5.
  static constexpr unsigned coarsest_grid = 8, finest_logged_grid = 200, finest_grid = 12800;
  [[nodiscard]] static unsigned next_grid(unsigned bits) {
    if (bits >= finest_logged_grid) return 2 * bits;
    return bits + (bits < 32 ? 4 : 12);
  }

  void forget_steps(const StaticTriangulation<Dimension>& built);
  /// The static diagram at `time`; false, and nothing changed, where it is flat.
  [[nodiscard]] bool assign_static(const Dyadic& time);
  /// `fast`: rebuilds near now from doubles, a few times a step; what is violated then stays so.
  void rebuild_roughly();
  void drop_all();
  /// Times after now before which a rebuild must be, of what the one just made contradicts.
  [[nodiscard]] std::vector<ExactTime> contradictions(const Dyadic& time);
  /// Those at which certificates that do not hold just after now begin to.
  void add_beginnings(std::vector<ExactTime>& times);
  /// Puts other cells in the place of these, or of these and those around them; false where it cannot.
  [[nodiscard]] bool repair(std::vector<CellId> wrong);
  [[nodiscard]] bool try_to_repair(std::span<const CellId> wrong);
  /// Records a rebuild at `time` that replaces `cells_before`.
  void record(const Dyadic& time, std::span<const Beads> cells_before);

  State& state_;
  FacetGuards<Dimension>& facets_;
  HiddenGuards<Dimension>& hidden_;
  CellExchange<Dimension> exchange_;
  int rough_rebuilds_ = 0;                         // in this step
  unsigned coarsest_that_worked_ = coarsest_grid;  // in this step: blocked flips come in crowds
};

extern template class DiagramRebuilder<2>;
extern template class DiagramRebuilder<3>;

}  // namespace kds
