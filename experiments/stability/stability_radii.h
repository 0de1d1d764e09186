#pragma once
// Provides radii for scenes without radii.

#include "experiments/stability/bead_curves.h"
#include "experiments/stability/stability_scenes.h"

namespace kds {

/// Sets radii unless there are any. The radii are equal or unequal, constant or changing, and no larger than
/// the distance between beads. Mostly they take few different values, so that balls touch and radii tie.
void give_radii(BeadCurves& beads, SceneRandom& random);

}  // namespace kds
