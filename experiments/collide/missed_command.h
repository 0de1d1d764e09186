#pragma once
// `kds missed`: which share of the contacts of a run is missed by looking at frames only.

#include "experiments/collide/missed_contacts.h"
#include "experiments/output/destinations.h"
#include "experiments/program/command_line.h"

namespace kds {

struct MissedOptions {
  MissedTask task;
  Destinations destinations;
};

/// Throws InputError naming the option and what it takes, HelpRequest for --help. Opens no file.
[[nodiscard]] MissedOptions parse_missed_options(const Arguments& arguments);

/// Throws InputError for what the arguments or inputs are at fault for; returns the exit code.
int missed_command(const Arguments& arguments);

}  // namespace kds
