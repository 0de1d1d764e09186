#pragma once
// `kds info`

#include "experiments/program/command_line.h"

namespace kds {

/// The exit code; what goes wrong is thrown. Violated conditions are no error.
int info_command(const Arguments& arguments);

}  // namespace kds
