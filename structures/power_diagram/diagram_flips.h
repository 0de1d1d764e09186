#pragma once
// Flips of a power diagram. When a certificate fails, the Radon partition of the beads decides the flip. In
// general position, the cells themselves show which flip it is, because only cells among these beads change.
//
// - In space: 4-1 if a vertex of the facet has exactly four cells, all among these beads; 3-2 if an edge has
//   exactly three; otherwise 2-3.
// - In the plane: 3-1 if a vertex has exactly three cells; otherwise 2-2.
//
// Conditions that general position does not guarantee are checked. New finite cells must be positive just
// after the event. On the hull, the removed faces and the added faces must turn the same way in their common
// plane now.

#include <cstdint>
#include <span>

#include "structures/power_diagram/facet_certificates.h"
#include "structures/power_diagram/hidden_certificates.h"

namespace kds {

template <int Dimension>
class DiagramFlips {
  using State = DiagramState<Dimension>;
  using Events = typename State::Events;
  using Beads = typename State::Beads;

 public:
  DiagramFlips(State& state, FacetCertificates<Dimension>& facets, HiddenCertificates<Dimension>& hidden)
      : state_(state), facets_(facets), hidden_(hidden) {}

  /// Handles the failure, at the present time, of the certificate in `slot` of a table: repairs the diagram
  /// or marks it as doubtful.
  void fail(unsigned table, std::uint32_t slot);
  /// Repeats a logged flip, or a logged event of a hidden bead, without certificates. Throws
  /// std::invalid_argument if it cannot be made.
  void apply(const Change& change);

 private:
  /// Sets the certificate that fails now as the present event.
  void begin_event(const Identity& identity);
  void repair(CellId cell, int facet);
  [[nodiscard]] bool can_replace(std::span<const Beads> old, std::span<const Beads> made);
  /// Positive new cells have no face that already exists, unless several events coincide.
  [[nodiscard]] bool may_stand_already() const {
    return state_.doubt != Doubt::none || state_.present.type == Orientation<Dimension>::type.number;
  }
  [[nodiscard]] bool stands_already(std::span<const BeadId> face, CellId a, CellId b) const;
  void flip_to_edge(CellId cell, int facet);
  void flip_to_facet(CellId cell, int facet, int other_vertex) requires(Dimension == 3);
  void show(BeadId bead, CellId cell);
  void hide(CellId cell, int i);
  void apply_to_facet(const Change& change) requires(Dimension == 3);
  void apply_to_hidden(const Change& change);

  State& state_;
  FacetCertificates<Dimension>& facets_;
  HiddenCertificates<Dimension>& hidden_;
  Identity last_identity_;
  std::uint64_t last_moment_ = 0;
};

extern template class DiagramFlips<2>;
extern template class DiagramFlips<3>;

}  // namespace kds
