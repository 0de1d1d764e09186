#pragma once
// Radii for scenes that leave them out.

#include "experiments/stability/bead_curves.h"
#include "experiments/stability/stability_scenes.h"

namespace kds {

/// Leaves radii alone if there are any. Else equal or unequal ones, constant or changing, no larger than
/// beads are apart; mostly few different ones, so that balls touch and radii tie.
void give_radii(BeadCurves& beads, SceneRandom& random);

}  // namespace kds
