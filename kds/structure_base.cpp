#include "kds/structure_base.h"

#include <algorithm>

namespace kds {

void StructureBase::record(std::size_t kind, std::initializer_list<BeadId> ids) const {
  Change change{static_cast<std::uint8_t>(kind), static_cast<std::uint8_t>(ids.size()), {}};
  std::copy(ids.begin(), ids.end(), change.ids.begin());
  record(change);
}

void EditableBase::edit_now(std::uint8_t kind, BeadId bead) {
  const Simulator::ComputeScope scope(simulator());
  present_.require(bead, kind == inserted());
  simulator().require_standing_still();
  edit(kind, bead);
}

void EditableBase::take_up(std::span<const BeadId> beads) {
  const std::size_t changed = kinds().size() - 1;
  for (const BeadId bead : beads)
    if (!is_absent(bead)) record(changed, {bead});
  follow(beads);
}

}  // namespace kds
