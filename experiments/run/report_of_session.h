#pragma once
// Collects what the structures of a session counted.

#include "experiments/run/run_options.h"
#include "experiments/run/run_report.h"
#include "experiments/run/step_counts.h"
#include "structures/session/session.h"

namespace kds {

[[nodiscard]] RunReport report_of(Session& session, const Scene& scene, const RunOptions& options,
                                  const StepCounts& counts);

}  // namespace kds
