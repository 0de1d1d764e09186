#pragma once
// Runs a logged run again and compares what happens with the log.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "experiments/run/run_report.h"
#include "experiments/run/run_scene.h"

namespace kds {

struct ReplayReport {
  RunReport run;                         ///< what happened this time
  std::uint64_t logged_fingerprint = 0;  ///< at the end of the log
  std::uint64_t events = 0;              ///< in the log

  [[nodiscard]] bool same() const { return run.fingerprint == logged_fingerprint; }
};

/// Throws InputError naming the log, or the inputs it names, where they cannot be used.
[[nodiscard]] ReplayReport replay_log(const std::filesystem::path& log, const Progress& progress,
                                      const std::function<void(const std::string&)>& warn);

}  // namespace kds
