#pragma once
// `kds theorems`: what the paper's theorems bound, measured over sizes.

#include "experiments/program/command_line.h"

namespace kds {

int theorems_command(const Arguments& arguments);

}  // namespace kds
