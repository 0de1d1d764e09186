#pragma once
// `kds compare`: how often structures change, by stride, motion and input.

#include "experiments/program/command_line.h"

namespace kds {

/// Throws InputError for what the arguments or inputs are at fault for; returns the exit code.
int compare_command(const Arguments& arguments);

}  // namespace kds
