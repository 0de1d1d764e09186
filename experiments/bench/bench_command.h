#pragma once
// `kds bench`

#include "experiments/program/command_line.h"

namespace kds {

/// The exit code: 0, also where a goal is missed; what goes wrong is thrown.
int bench_command(const Arguments& arguments);

}  // namespace kds
