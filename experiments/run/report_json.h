#pragma once
// Writes a run as JSON, for summary.json and --json.

#include <filesystem>
#include <string>

#include "experiments/run/replay_log.h"
#include "experiments/run/run_report.h"

namespace kds {

/// Returns JSON text that ends with a newline.
[[nodiscard]] std::string report_json(const RunReport& report);

/// Returns the JSON of report_json with an additional object `replay`. Its members are log, events,
/// logged_fingerprint, same and difference (null if there is no difference).
[[nodiscard]] std::string replay_json(const ReplayReport& replay, const std::filesystem::path& log);

}  // namespace kds
