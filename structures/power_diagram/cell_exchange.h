#pragma once
// Replaces some cells of a power diagram by others. Edits do this, and so do repairs after flips that block
// each other. The new cells are taken from a static triangulation of the beads around; the facets that bound
// the old cells stay. All signs are exact and are taken just after the present time.

#include <span>
#include <vector>

#include "structures/power_diagram/facet_certificates.h"
#include "structures/power_diagram/hidden_certificates.h"

namespace kds {

template <int Dimension>
class CellExchange {
  using State = DiagramState<Dimension>;
  using Beads = typename State::Beads;
  using Events = typename State::Events;

 public:
  CellExchange(State& state, FacetCertificates<Dimension>& facets, HiddenCertificates<Dimension>& hidden)
      : state_(state), facets_(facets), hidden_(hidden) {}

  /// Returns cells that fill `hole`. The cells are taken from the static triangulation of `beads` at `time`;
  /// `beads` must include all beads around the hole. Returns an empty vector if this triangulation lacks one
  /// of the facets that bound the hole.
  [[nodiscard]] std::vector<Beads> fill_of(std::span<const CellId> hole, std::vector<BeadId> beads,
                                           const Dyadic& time) const;
  /// Returns whether the cells `made` fit into the hole with all finite cells positive.
  [[nodiscard]] bool can_fill(std::span<const CellId> hole, std::span<const Beads> made);
  /// Returns whether cells that fit into the hole are regular, together with the cells around them.
  [[nodiscard]] bool is_regular(std::span<const CellId> hole, std::span<const Beads> made);
  /// Exchanges the cells, records the exchange and creates the certificates of the new cells. The hidden
  /// beads of the hole must already be displaced.
  void fill(std::span<const CellId> hole, std::span<const Beads> made);
  /// Records that the cells `gone` are removed and the cells `made`, positively oriented, are added. Returns
  /// the added cells as they are recorded, sorted.
  std::vector<Beads> record(std::span<const Beads> gone, std::span<const Beads> made);
  /// Only exchanges the cells. Beads that lose all their cells become hidden and displaced; hidden beads that
  /// get cells become visible.
  std::vector<CellId> exchange(std::span<const CellId> hole, std::span<const Beads> made);

 private:
  State& state_;
  FacetCertificates<Dimension>& facets_;
  HiddenCertificates<Dimension>& hidden_;
};

extern template class CellExchange<2>;
extern template class CellExchange<3>;

}  // namespace kds
