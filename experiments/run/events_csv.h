#pragma once
// How often each structure changed, frame by frame, for other programs to plot.

#include <string>

#include "experiments/run/run_report.h"

namespace kds {

/// Header `frame,structure,events,cumulative`, then one line per frame and structure. Frame k stands for the
/// time from frame k to the next; events are external ones.
[[nodiscard]] std::string events_csv(const RunReport& report);

}  // namespace kds
