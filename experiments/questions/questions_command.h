#pragma once
// `kds questions`: what the paper leaves open, measured.

#include "experiments/program/command_line.h"

namespace kds {

int questions_command(const Arguments& arguments);

}  // namespace kds
