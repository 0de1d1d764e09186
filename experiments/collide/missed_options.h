#pragma once
// The options of `kds missed`.

#include "experiments/collide/missed_contacts.h"
#include "experiments/output/output_files.h"
#include "experiments/program/command_line.h"
#include "experiments/program/option.h"

namespace kds {

struct MissedOptions {
  MissedTask task;
  Destinations destinations;
};

/// Returns the options that appear as settings in the JSON.
[[nodiscard]] const OptionList<MissedTask>& missed_task_options();

/// Parses the options. Throws an InputError that names the option and what it takes. Throws HelpRequest for
/// --help. Opens no file.
[[nodiscard]] MissedOptions parse_missed_options(const Arguments& arguments);

}  // namespace kds
