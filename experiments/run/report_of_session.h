#pragma once
// Collects the counts of a session's structures.

#include "experiments/run/run_options.h"
#include "experiments/run/run_report.h"
#include "experiments/run/step_counts.h"
#include "structures/session/session.h"

namespace kds {

[[nodiscard]] RunReport report_of(Session& session, const Scene& scene, const RunOptions& options,
                                  const StepCounts& counts);

}  // namespace kds
