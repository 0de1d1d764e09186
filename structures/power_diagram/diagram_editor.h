#pragma once
// Beads that come, go and change course while time runs. All signs are taken just after the present time,
// exactly.
//
//   insert   on a walk to where the bead is; the cells whose power spheres hold it are replaced by those that
//            join it to the facets around them (Bowyer-Watson), or it is hidden. Beads in their midst are
//            hidden from then on.
//   erase    the cells around it are replaced by those of the static triangulation of their other beads and
//            of the beads hidden there that fill the same place: all of these are cells of the whole, and
//            hidden beads come back as they are in it.
//   change   the certificates that name the bead are made anew; where it jumps, it is erased and inserted.
//            Of many beads at once, or where the others alone would have no diagram: all certificates; where
//            any jumps, all cells, and that is counted.
//
// At an irrational time, that of an event, nobody can build a static triangulation: cells come from one at a
// time soon after, once their signs just after the present time say that they are those of then. And whether
// a bead jumps is not looked at: it is taken to, unless its curve is the one that it had.
//
// Infinite cells take part like any other. Ties for good (whole grids at rest) may leave flat cells, or a
// static triangulation that decided otherwise than the cells that stay: then all is built anew, and counted.

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "motions/numbers/exact_number.h"
#include "structures/power_diagram/cell_exchange.h"
#include "structures/power_diagram/diagram_rebuilder.h"

namespace kds {

template <int Dimension>
class DiagramEditor {
  using State = DiagramState<Dimension>;
  using Beads = typename State::Beads;
  using Events = typename State::Events;
  using Kind = typename Events::Kind;
  using ExactPosition = std::array<Rational, static_cast<std::size_t>(Dimension) + 1>;

 public:
  DiagramEditor(State& state, FacetGuards<Dimension>& facets, HiddenGuards<Dimension>& hidden,
                DiagramRebuilder<Dimension>& rebuilder)
      : state_(state),
        facets_(facets),
        hidden_(hidden),
        rebuilder_(rebuilder),
        exchange_(state, facets, hidden) {}

  // What PowerDiagram says of them.
  void insert(BeadId bead, BeadId near);
  void erase(BeadId bead);
  void require_release(std::span<const BeadId> beads) const;
  void release(std::span<const BeadId> beads);
  void take_up();

  /// Makes a logged edit again, without certificates: first the cells that it clears and fills. No cells
  /// before it: the bead is hidden, or a rebuild follows. Throws std::invalid_argument if it cannot be made.
  void apply(const Change& change);

 private:
  void require_time() const;
  void require_cells() const;
  static constexpr const char* in_what = Dimension == 3 ? "in one plane" : "on one line";
  /// Whether the others are too few for a diagram, or stay in one plane (on one line).
  [[nodiscard]] bool is_flat_without(BeadId bead) const;
  [[nodiscard]] bool stays_flat(std::span<const BeadId> beads) const;
  /// The present time, if it is rational.
  [[nodiscard]] std::optional<Dyadic> rational_now() const;
  void put_in(BeadId bead, CellId from);
  /// With the cells around it, whose hidden beads are displaced.
  void take_out(BeadId bead, std::span<const CellId> hole);
  void take_out_hidden(BeadId bead);
  /// Cells in its place as they are at `time`, without the bead.
  [[nodiscard]] std::vector<Beads> fill_without(BeadId bead, std::span<const CellId> hole,
                                                const Dyadic& time) const;
  [[nodiscard]] std::vector<ExactPosition> positions_of_released(const Dyadic& time) const;
  [[nodiscard]] std::vector<double> numbers_of_released() const;
  void move_elsewhere(BeadId bead);
  [[nodiscard]] CellId cell_near(BeadId near) const;
  [[nodiscard]] int power_against(BeadId bead, CellId cell);
  [[nodiscard]] std::vector<CellId> cells_in_conflict(BeadId bead, CellId start, bool zero_too);
  [[nodiscard]] std::vector<Beads> star_in_place_of(std::span<const CellId> hole, BeadId bead) const;
  void finish_edit(Kind kind, BeadId bead);
  void settle();
  void rebuild_after_edit(Kind kind, BeadId bead);

  State& state_;
  FacetGuards<Dimension>& facets_;
  HiddenGuards<Dimension>& hidden_;
  DiagramRebuilder<Dimension>& rebuilder_;
  CellExchange<Dimension> exchange_;
  // Beads between two courses, the control points of the first, where they are if that is rational, and the
  // cells around one of them.
  std::vector<BeadId> released_;
  std::vector<double> numbers_before_;
  std::vector<ExactPosition> before_;
  std::vector<CellId> around_;
  // Replay: cells that the edit being read clears and fills.
  std::vector<CellId> cleared_;
  std::vector<Beads> filled_;
};

extern template class DiagramEditor<2>;
extern template class DiagramEditor<3>;

}  // namespace kds
