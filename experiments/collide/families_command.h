#pragma once
// `kds families`: sizes of separating families of packed grids, and the exponents at which they grow.

#include "experiments/program/command_line.h"

namespace kds {

/// Throws InputError for what the arguments are at fault for; returns the exit code.
int families_command(const Arguments& arguments);

}  // namespace kds
