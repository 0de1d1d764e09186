#pragma once
// Inserts and erases beads and gives them other curves during a run. All signs are exact and are taken just
// after the present time.
//
//   insert   Walks to the bead's position. The cells whose power spheres contain the bead are replaced by the
//            cells that join the bead to the facets around them (Bowyer-Watson); if there are none, the bead
//            is hidden. Beads inside the replaced cells become hidden.
//   erase    Builds the static triangulation of the other beads of the cells around the bead and of the
//            beads hidden there. Its cells that fill the same region replace the cells around the bead. These
//            are cells of the whole diagram too, and hidden beads become visible if they are vertices there.
//   change   Makes the certificates that name the bead anew. If the bead jumps, it is erased and inserted.
//            If many beads change at once, or if the others alone would have no diagram, all certificates are
//            made anew; if any of these beads jumps, all cells are rebuilt, and the rebuild is counted.
//
// No static triangulation can be built at an irrational time, which is the time of an event. Instead, cells
// are taken from a static triangulation at a rational time soon after; they are accepted if their signs just
// after the present time prove them correct at that time. At an irrational time, every bead whose curve
// changes is treated as if it jumped.
//
// Infinite cells are treated like any others. Permanent ties (for example a whole grid at rest) may leave
// flat cells, or a static triangulation may resolve a tie differently from the cells that stay. In this case
// the whole diagram is rebuilt, and the rebuild is counted.

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
  DiagramEditor(State& state, FacetCertificates<Dimension>& facets, HiddenCertificates<Dimension>& hidden,
                DiagramRebuilder<Dimension>& rebuilder)
      : state_(state),
        facets_(facets),
        hidden_(hidden),
        rebuilder_(rebuilder),
        exchange_(state, facets, hidden) {}

  // Implements the functions of PowerDiagram with these names.
  void insert(BeadId bead, BeadId near);
  void erase(BeadId bead);
  void require_release(std::span<const BeadId> beads) const;
  void release(std::span<const BeadId> beads);
  void take_up();

  /// Repeats a logged edit without certificates, beginning with the cells that it clears and fills. If no
  /// cells precede the edit, the bead is hidden or a rebuild follows. Throws std::invalid_argument if the
  /// edit cannot be made.
  void apply(const Change& change);

 private:
  void require_time() const;
  void require_cells() const;
  static constexpr const char* in_what = Dimension == 3 ? "in one plane" : "on one line";
  /// Returns whether the other beads are too few for a diagram, or stay in one plane (on one line).
  [[nodiscard]] bool is_flat_without(BeadId bead) const;
  [[nodiscard]] bool stays_flat(std::span<const BeadId> beads) const;
  /// Returns the present time if it is a multiple of 2^-200 or is already known as a dyadic number.
  [[nodiscard]] std::optional<Dyadic> rational_now() const;
  void put_in(BeadId bead, CellId from);
  /// Removes the bead together with the cells around it, whose hidden beads are displaced.
  void take_out(BeadId bead, std::span<const CellId> hole);
  void take_out_hidden(BeadId bead);
  /// Returns cells that fill the hole that the bead leaves, as they are at `time` without the bead.
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
  FacetCertificates<Dimension>& facets_;
  HiddenCertificates<Dimension>& hidden_;
  DiagramRebuilder<Dimension>& rebuilder_;
  CellExchange<Dimension> exchange_;
  // Beads between release and take_up, the control points of their old curves, their positions now if the
  // time is rational, and the cells around the bead if it is a single one.
  std::vector<BeadId> released_;
  std::vector<double> numbers_before_;
  std::vector<ExactPosition> before_;
  std::vector<CellId> around_;
  // Replay: the cells that the edit being read clears and fills.
  std::vector<CellId> cleared_;
  std::vector<Beads> filled_;
};

extern template class DiagramEditor<2>;
extern template class DiagramEditor<3>;

}  // namespace kds
