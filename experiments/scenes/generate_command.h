#pragma once
// `kds generate`

#include "experiments/program/command_line.h"

namespace kds {

/// The exit code; what goes wrong is thrown.
int generate_command(const Arguments& arguments);

}  // namespace kds
