#pragma once
// `kds run`: its options, and what each accepts.

#include "experiments/program/option.h"
#include "experiments/run/run_options.h"

namespace kds {

/// --out, --json and --quiet of a run, which its replay has too.
[[nodiscard]] OptionList<Destinations> run_destination_options();

/// All options of `kds run`.
[[nodiscard]] const OptionList<RunOptions>& run_options();

/// Throws InputError naming the option and what it takes, HelpRequest for --help. Opens no file.
[[nodiscard]] RunOptions parse_run_options(const Arguments& arguments);

/// The arguments that ask for the same run from any directory, without its outputs.
[[nodiscard]] Arguments repeating_arguments(const RunOptions& options);

}  // namespace kds
