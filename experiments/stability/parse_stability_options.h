#pragma once
// `kds stability`: its options, and what each accepts.

#include "experiments/program/command_line.h"
#include "experiments/stability/stability_options.h"

namespace kds {

/// Throws InputError naming the option and what it takes, HelpRequest for --help.
[[nodiscard]] StabilityOptions parse_stability_options(const Arguments& arguments);

}  // namespace kds
