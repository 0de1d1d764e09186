#pragma once
// Runs the kinetic structures over the inputs of one `kds run` and reports what happened.

#include <functional>

#include "experiments/run/run_options.h"
#include "experiments/run/run_report.h"
#include "experiments/run/run_results.h"
#include "experiments/run/run_steps.h"

namespace kds {

/// Warnings about the input go to `warn`, one line each; what is written to `results`, which is delivered by
/// the caller. Throws InputError for what a user can mend, and AuditError (kds/audit.h) where a structure
/// disagrees with its static rebuild.
[[nodiscard]] RunReport run_scene(const RunOptions& options, const Progress& progress,
                                  const std::function<void(const std::string&)>& warn, RunResults& results);

}  // namespace kds
