#pragma once
// `kds update`: techniques that bring the power diagram from frame to frame, compared.

#include "experiments/program/command_line.h"

namespace kds {

/// Throws InputError for what the arguments or inputs are at fault for; returns the exit code.
int update_command(const Arguments& arguments);

}  // namespace kds
