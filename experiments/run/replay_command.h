#pragma once
// Runs a logged run again and compares its events one by one with the log. Keeps neither list of events in
// memory.

#include <filesystem>
#include <functional>
#include <string>

#include "experiments/run/run_options.h"
#include "experiments/run/run_report.h"
#include "experiments/run/run_results.h"
#include "experiments/run/run_scene.h"

namespace kds {

/// Replays the log. Throws an InputError that names the log or its inputs if they cannot be used, or if a
/// line of the log was not written by the run.
///
/// Two events are the same if their structure, kind, beads and time agree. The times agree if the log's
/// bracket is the canonical one or, in logs of earlier versions, holds the exact failure time.
[[nodiscard]] ReplayReport replay_log(const std::filesystem::path& log, const Progress& progress,
                                      const std::function<void(const std::string&)>& warn,
                                      RunResults* results = nullptr);

}  // namespace kds
