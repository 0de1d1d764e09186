#pragma once
// `kds stability`

#include "experiments/program/command_line.h"

namespace kds {

/// The exit code: 1 if some row does not hold; what goes wrong is thrown.
int stability_command(const Arguments& arguments);

}  // namespace kds
