#pragma once
// Runs the kinetic structures over the inputs of one `kds run` and reports what happened.

#include <functional>

#include "experiments/run/run_options.h"
#include "experiments/run/run_report.h"
#include "experiments/run/run_results.h"
#include "experiments/run/run_steps.h"

namespace kds {

/// Runs the structures. Each warning about the input goes to `warn` as one line. The output goes to
/// `results`, which the caller delivers. Throws InputError for errors that the user can fix. Throws
/// AuditError (kds/audit.h) if a structure disagrees with its static rebuild.
[[nodiscard]] RunReport run_scene(const RunOptions& options, const Progress& progress,
                                  const std::function<void(const std::string&)>& warn, RunResults& results);

}  // namespace kds
