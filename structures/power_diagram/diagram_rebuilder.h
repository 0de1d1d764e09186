#pragma once
// Rebuilds a power diagram if flips do not suffice: simultaneous events that block each other, cells that
// turn over without an event, and frames at which beads coincide or all lie in one plane. CGAL builds the
// diagram anew with exact numbers, at a time so soon after the present one that no event is skipped, and the
// rebuild is counted. If the wrong cells are known and few, only these cells and possibly some rings around
// them are replaced.

#include <vector>

#include "certificates/exact/exact_time.h"
#include "structures/power_diagram/cell_exchange.h"
#include "structures/power_diagram/facet_certificates.h"
#include "structures/power_diagram/hidden_certificates.h"

namespace kds {

template <int Dimension>
class DiagramRebuilder {
  using State = DiagramState<Dimension>;
  using Events = typename State::Events;
  using Beads = typename State::Beads;

 public:
  DiagramRebuilder(State& state, FacetCertificates<Dimension>& facets, HiddenCertificates<Dimension>& hidden)
      : state_(state), facets_(facets), hidden_(hidden), exchange_(state, facets, hidden) {}

  /// Builds the diagram from the k-th control points, at an end of the step.
  void build_from_control_points(int k);
  /// Builds the diagram by CGAL at the end of the step. The mirror is made when the next step starts.
  void build_bare_at_end();
  /// Resets the counts that limit rebuilds within a step.
  void start_step();
  /// Creates the certificates of all facets and all hidden beads.
  void watch_all();
  /// Called after the events of one time: if the diagram is wrong just after them, repairs or rebuilds it.
  void after_batch();
  /// Rebuilds the diagram. Returns false, and leaves no cells, if all beads stay in one plane or on one line.
  [[nodiscard]] bool try_to_rebuild();
  /// Tries times after now on ever finer grids, and rebuilds at the first one before which nothing fails.
  void rebuild_at_first_time_that_works();
  /// Throws the error that no cells can be built in this step.
  [[noreturn]] static void refuse_flat(std::size_t step);
  /// Repeats a logged rebuild without certificates. Throws std::invalid_argument if it cannot be made.
  void apply(const Change& change);
  /// Repeats a rebuild whose cells are in the log, positively oriented, including infinite ones.
  void assign_logged(std::span<const Beads> cells);

 private:
  // Bits after the point of a rebuild's time. Up to the finest logged grid, the log holds the time, because
  // its numerator fits into a Change. Beyond this grid, the log holds all cells removed and added, and the
  // number of bits doubles up to the finest grid. The finest grid suffices for doubles of all exponents
  // (2^-1074 to 2^1024): roots can be as close as 2^-2098 of a step in lengths, and 2^-10490 in power tests,
  // which have degree 5.
  static constexpr unsigned coarsest_grid = 8, finest_logged_grid = 200, finest_grid = 12800;
  [[nodiscard]] static unsigned next_grid(unsigned bits) {
    if (bits >= finest_logged_grid) return 2 * bits;
    return bits + (bits < 32 ? 4 : 12);
  }

  void forget_steps(const StaticTriangulation<Dimension>& built);
  /// Assigns the static diagram at `time`. Returns false, and changes nothing, if that diagram is flat.
  [[nodiscard]] bool assign_static(const Dyadic& time);
  void drop_all();
  /// Returns the times after now that must follow the rebuild, because certificates of the diagram just built
  /// fail or begin to hold there.
  [[nodiscard]] std::vector<ExactTime> contradictions(const Dyadic& time);
  /// Adds the times at which certificates that do not hold just after now begin to hold.
  void add_beginnings(std::vector<ExactTime>& times);
  /// Replaces these cells, or these and rings of cells around them. Returns false if this is not possible.
  [[nodiscard]] bool repair(std::vector<CellId> wrong);
  [[nodiscard]] bool try_to_repair(std::span<const CellId> wrong);
  /// Records a rebuild at `time` that replaces `cells_before`.
  void record(const Dyadic& time, std::span<const Beads> cells_before);

  State& state_;
  FacetCertificates<Dimension>& facets_;
  HiddenCertificates<Dimension>& hidden_;
  CellExchange<Dimension> exchange_;
  unsigned coarsest_that_worked_ = coarsest_grid;  // in this step; blocked flips come in groups
};

extern template class DiagramRebuilder<2>;
extern template class DiagramRebuilder<3>;

}  // namespace kds
