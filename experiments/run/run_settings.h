#pragma once
// Options of a run by the names that users give them, both ways: for reports, and for logs to be read again.

#include <string>
#include <utility>
#include <vector>

#include "experiments/run/run_options.h"

namespace kds {

/// What was asked for, by option.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> option_settings(const RunOptions& options);

/// The command line that asks for the same run: without outputs, paths made absolute.
[[nodiscard]] std::vector<std::string> option_arguments(const RunOptions& options);

}  // namespace kds
