#pragma once
// Runs a logged run again and compares what happens, event by event, with the log. Neither is kept.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "experiments/run/run_options.h"
#include "experiments/run/run_report.h"
#include "experiments/run/run_results.h"
#include "experiments/run/run_steps.h"

namespace kds {

struct ReplayReport {
  RunReport run;                         ///< what happened this time
  std::uint64_t logged_fingerprint = 0;  ///< at the end of the log
  std::uint64_t events = 0;              ///< in the log
  /// Where log and run part, as a sentence; none: every event is in both, at the same time.
  std::optional<std::string> difference = {};

  [[nodiscard]] bool same() const { return !difference && run.fingerprint == logged_fingerprint; }
};

/// What the logged run was asked for. Throws InputError naming the log where it is none.
[[nodiscard]] RunOptions logged_run(const std::filesystem::path& log);

/// Throws InputError naming the log, or the inputs it names, where they cannot be used, and where a line is
/// not one that the run wrote.
///
/// An event is the same if structure, kind and beads are, and its time: the bracket in the log is that of the
/// run, or, where another version of the program wrote the log, holds the exact failure time.
[[nodiscard]] ReplayReport replay_log(const std::filesystem::path& log, const Progress& progress,
                                      const std::function<void(const std::string&)>& warn,
                                      RunResults* results = nullptr);

}  // namespace kds
