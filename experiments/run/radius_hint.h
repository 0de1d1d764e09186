#pragma once
// Suggests a radius if a run has no contacts. With --radius auto the beads of a chain just touch.

#include <optional>
#include <string>

#include "motions/base/bead.h"
#include "motions/scene/scene.h"

namespace kds {

/// Returns one line that names a radius at which half of the beads that move touch another bead in the first
/// frame. Two beads of one chain count if they are at least `apart` apart, and at least 5 if the chain is
/// long enough. Returns nothing if beads meet in that frame, radii differ or no pair counts.
[[nodiscard]] std::optional<std::string> radius_hint(const Scene& scene, BeadId apart);

/// Returns a similar line that names a value of --factors instead. The radii of the scene are `factor` times
/// the radii of --radius auto.
[[nodiscard]] std::optional<std::string> factor_hint(const Scene& scene, double factor, BeadId apart);

/// Returns a similar part of a sentence that names a value of --cutoff, between centres or between surfaces.
[[nodiscard]] std::optional<std::string> cutoff_hint(const Scene& scene, bool between_surfaces, BeadId apart);

}  // namespace kds
