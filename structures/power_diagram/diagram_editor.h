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
//   change   the certificates that name the bead are made anew.
//
// Infinite cells take part like any other. Ties for good (whole grids at rest) may leave flat cells, or a
// static triangulation that decided otherwise than the cells that stay: then all is built anew, and counted.

#include <functional>
#include <span>
#include <vector>

#include "structures/power_diagram/cell_exchange.h"
#include "structures/power_diagram/diagram_rebuilder.h"

namespace kds {

template <int Dimension>
class DiagramEditor {
  using State = DiagramState<Dimension>;
  using Beads = typename State::Beads;
  using Events = typename State::Events;
  using Kind = typename Events::Kind;

 public:
  DiagramEditor(State& state, FacetGuards<Dimension>& facets, HiddenGuards<Dimension>& hidden,
                DiagramRebuilder<Dimension>& rebuilder)
      : state_(state),
        facets_(facets),
        hidden_(hidden),
        rebuilder_(rebuilder),
        exchange_(state, facets, hidden) {}

  // What PowerDiagram says of them.
  void leave_out(BeadId bead);
  void insert(BeadId bead, BeadId near);
  void erase(BeadId bead);
  void change_motion(BeadId bead, const std::function<void()>& set_curve);

  /// Makes a logged edit again, without certificates: first the cells that it clears and fills. No cells
  /// before it: the bead is hidden, or a rebuild follows. Throws std::invalid_argument if it cannot be made.
  void apply(const Change& change);

 private:
  void require_edit(BeadId bead, bool present) const;
  [[nodiscard]] Dyadic time_of_edit() const;
  void set_absent(BeadId bead, bool absent);
  void put_in(BeadId bead, CellId from);
  /// With the cells around it, whose hidden beads are displaced.
  void take_out(BeadId bead, std::span<const CellId> hole, const Dyadic& time);
  void take_out_hidden(BeadId bead);
  [[nodiscard]] CellId cell_near(BeadId near) const;
  [[nodiscard]] int power_against(BeadId bead, CellId cell);
  [[nodiscard]] std::vector<CellId> cells_in_conflict(BeadId bead, CellId start, bool zero_too);
  [[nodiscard]] std::vector<Beads> star_in_place_of(std::span<const CellId> hole, BeadId bead) const;
  void finish_edit(Kind kind, BeadId bead);
  void rebuild_after_edit(Kind kind, BeadId bead);

  State& state_;
  FacetGuards<Dimension>& facets_;
  HiddenGuards<Dimension>& hidden_;
  DiagramRebuilder<Dimension>& rebuilder_;
  CellExchange<Dimension> exchange_;
  // Replay: cells that the edit being read clears and fills.
  std::vector<CellId> cleared_;
  std::vector<Beads> filled_;
};

extern template class DiagramEditor<2>;
extern template class DiagramEditor<3>;

}  // namespace kds
