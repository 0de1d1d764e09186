#pragma once
// `kds run`: its options, and what each accepts.

#include "experiments/program/command_line.h"
#include "experiments/run/run_options.h"

namespace kds {

/// Throws InputError naming the option and what it takes, HelpRequest for --help. Opens no file.
[[nodiscard]] RunOptions parse_run_options(const Arguments& arguments);

}  // namespace kds
