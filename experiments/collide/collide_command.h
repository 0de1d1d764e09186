#pragma once
// `kds collide`: which beads collide in every frame of a trajectory, by each method.

#include "experiments/program/command_line.h"

namespace kds {

/// Throws InputError for what the arguments or inputs are at fault for; returns the exit code.
int collide_command(const Arguments& arguments);

}  // namespace kds
