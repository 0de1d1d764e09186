#pragma once
// Collects what the structures of a session counted.

#include "experiments/run_options.h"
#include "experiments/run_report.h"
#include "experiments/session.h"

namespace kds {

[[nodiscard]] RunReport report_of(Session& session, const Scene& scene, const RunOptions& options);

}  // namespace kds
