#pragma once
// The options of `kds missed`.

#include "experiments/collide/missed_contacts.h"
#include "experiments/output/destinations.h"
#include "experiments/program/command_line.h"
#include "experiments/program/option.h"

namespace kds {

struct MissedOptions {
  MissedTask task;
  Destinations destinations;
};

/// The options that are settings of the JSON.
[[nodiscard]] const OptionList<MissedTask>& missed_task_options();

/// Throws InputError naming the option and what it takes, HelpRequest for --help. Opens no file.
[[nodiscard]] MissedOptions parse_missed_options(const Arguments& arguments);

}  // namespace kds
