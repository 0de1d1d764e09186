#pragma once
// Runs the kinetic structures over the inputs of one `kds run` and reports what happened.

#include <cstddef>
#include <functional>

#include "experiments/run/run_options.h"
#include "experiments/run/run_report.h"

namespace kds {

/// Called after each motion step with the steps done and the steps in all.
using Progress = std::function<void(std::size_t done, std::size_t total)>;

/// Warnings about the input go to `warn`, one line each. Throws InputError for what a user can mend, and
/// AuditError (kds/audit.h) where a structure disagrees with its static rebuild.
[[nodiscard]] RunReport run_scene(const RunOptions& options, const Progress& progress,
                                  const std::function<void(const std::string&)>& warn);

}  // namespace kds
