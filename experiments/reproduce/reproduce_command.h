#pragma once
// `kds reproduce`: the paper's tables, measured again.

#include "experiments/program/command_line.h"

namespace kds {

/// Throws InputError for what the arguments or inputs are at fault for; returns the exit code.
int reproduce_command(const Arguments& arguments);

}  // namespace kds
