#pragma once
// Some cells of a power diagram in the place of others: what an edit does, and what is done where flips block
// each other. The new ones are of a static triangulation of the beads around; the facets that bound the old
// ones stay. All signs are taken just after the present time, exactly.

#include <span>
#include <vector>

#include "structures/power_diagram/facet_guards.h"
#include "structures/power_diagram/hidden_guards.h"

namespace kds {

template <int Dimension>
class CellExchange {
  using State = DiagramState<Dimension>;
  using Beads = typename State::Beads;
  using Events = typename State::Events;

 public:
  CellExchange(State& state, FacetGuards<Dimension>& facets, HiddenGuards<Dimension>& hidden)
      : state_(state), facets_(facets), hidden_(hidden) {}

  /// Cells for the place of some, of the static triangulation of some beads at `time`, among them all around
  /// that place; none if it does not have the facets around.
  [[nodiscard]] std::vector<Beads> fill_of(std::span<const CellId> hole, std::vector<BeadId> beads,
                                           const Dyadic& time) const;
  /// Whether they fit in, finite ones positive.
  [[nodiscard]] bool can_fill(std::span<const CellId> hole, std::span<const Beads> made);
  /// Whether cells that fit in are regular, with those around them.
  [[nodiscard]] bool is_regular(std::span<const CellId> hole, std::span<const Beads> made);
  /// Exchanges cells whose hidden beads are displaced, records that, and guards the new ones.
  void fill(std::span<const CellId> hole, std::span<const Beads> made);
  /// Records that some cells go and that others, positively oriented, come. Returns the latter as they are
  /// recorded, sorted.
  std::vector<Beads> record(std::span<const Beads> gone, std::span<const Beads> made);
  /// The exchange alone. Beads that have no cell any more are hidden, and displaced; hidden ones that have
  /// cells come back.
  std::vector<CellId> exchange(std::span<const CellId> hole, std::span<const Beads> made);

 private:
  State& state_;
  FacetGuards<Dimension>& facets_;
  HiddenGuards<Dimension>& hidden_;
};

extern template class CellExchange<2>;
extern template class CellExchange<3>;

}  // namespace kds
