#pragma once
// The radius to try where a run has no contacts, since with --radius auto the beads of a chain just touch.

#include <optional>
#include <string>

#include "motions/base/bead.h"
#include "motions/scene/scene.h"

namespace kds {

/// One line that names a radius at which half of the beads touch another in the first frame. Of beads of one
/// chain it asks about those at least `apart` apart, and 5 where the chain is long enough. None where beads
/// meet in that frame, where radii differ, and where no pair is asked about.
[[nodiscard]] std::optional<std::string> radius_hint(const Scene& scene, BeadId apart);

}  // namespace kds
