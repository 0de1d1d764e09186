#pragma once
// Flips of a power diagram. When a certificate fails, the Radon partition of the beads decides the flip. In
// general position the cells themselves tell which it is, for those among the beads change: in space 4-1 if a
// vertex of the facet has just four cells, all among them, 3-2 if an edge has just three, else 2-3; in the
// plane 3-1 if a vertex has just three, else 2-2. What general position does not guarantee is checked: finite
// new cells must be positive just after the event, and on the hull the faces that go and those that come must
// turn the same way in their common plane now.

#include <cstdint>
#include <span>

#include "structures/power_diagram/facet_guards.h"
#include "structures/power_diagram/hidden_guards.h"

namespace kds {

template <int Dimension>
class DiagramFlips {
  using State = DiagramState<Dimension>;
  using Events = typename State::Events;
  using Beads = typename State::Beads;

 public:
  DiagramFlips(State& state, FacetGuards<Dimension>& facets, HiddenGuards<Dimension>& hidden)
      : state_(state), facets_(facets), hidden_(hidden) {}

  /// The certificate in `slot` of a table fails now: the diagram is repaired, or in doubt.
  void fail(unsigned table, std::uint32_t slot);
  /// Makes a logged flip again, or what happened to a hidden bead, without certificates. Throws
  /// std::invalid_argument if it cannot be made.
  void apply(const Change& change);

 private:
  /// The certificate that fails now.
  void begin_event(const Identity& identity);
  void repair(CellId cell, int facet);
  [[nodiscard]] bool can_replace(std::span<const Beads> old, std::span<const Beads> made);
  /// In exact geometry new cells that are positive have no face that stands already, unless more happens at
  /// once.
  [[nodiscard]] bool may_stand_already() const {
    return state_.simulator.kernel() == Kernel::fast || state_.doubt != Doubt::none ||
           state_.present.type == Orientation<Dimension>::type.number;
  }
  [[nodiscard]] bool stands_already(std::span<const BeadId> face, CellId a, CellId b) const;
  void flip_to_edge(CellId cell, int facet);
  void flip_to_facet(CellId cell, int facet, int other_vertex) requires(Dimension == 3);
  void show(BeadId bead, CellId cell);
  void hide(CellId cell, int i);
  void apply_to_facet(const Change& change) requires(Dimension == 3);
  void apply_to_hidden(const Change& change);

  State& state_;
  FacetGuards<Dimension>& facets_;
  HiddenGuards<Dimension>& hidden_;
  Identity last_identity_;
  std::uint64_t last_moment_ = 0;
};

extern template class DiagramFlips<2>;
extern template class DiagramFlips<3>;

}  // namespace kds
