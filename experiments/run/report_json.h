#pragma once
// A run as JSON: summary.json and --json.

#include <filesystem>
#include <string>

#include "experiments/run/replay_log.h"
#include "experiments/run/run_report.h"

namespace kds {

/// Ends with a newline.
[[nodiscard]] std::string report_json(const RunReport& report);

/// The same with an object `replay`: log, events, logged_fingerprint, same, difference (null where there is
/// none).
[[nodiscard]] std::string replay_json(const ReplayReport& replay, const std::filesystem::path& log);

}  // namespace kds
