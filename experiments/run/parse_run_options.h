#pragma once
// The options of `kds run` and the values that each accepts.

#include "experiments/program/option.h"
#include "experiments/run/run_options.h"

namespace kds {

/// Returns the options --out, --json and --quiet of a run. The replay of a run has the same options.
[[nodiscard]] OptionList<Destinations> run_destination_options();

/// Returns all options of `kds run`.
[[nodiscard]] const OptionList<RunOptions>& run_options();

/// Parses the arguments of `kds run`. Throws an InputError that names the option and what it takes. Throws
/// HelpRequest for --help. Opens no file.
[[nodiscard]] RunOptions parse_run_options(const Arguments& arguments);

/// Returns the arguments that ask for the same run, without its outputs, from any directory.
[[nodiscard]] Arguments repeating_arguments(const RunOptions& options);

}  // namespace kds
