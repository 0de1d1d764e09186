#pragma once
// `kds run`

#include "experiments/program/command_line.h"

namespace kds {

/// The exit code; what goes wrong is thrown.
int run_command(const Arguments& arguments);

}  // namespace kds
