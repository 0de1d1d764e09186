#pragma once
// How often each structure changed, frame by frame, for other programs to plot.

#include <string>

#include "experiments/run/run_report.h"

namespace kds {

/// Header `frame,structure,events,cumulative`, then one line per frame and structure. Frame k, by its number
/// in the file, stands for the time from there to the next frame of the run; events are external ones. Where
/// the file has times, `picoseconds` follows: of frame k.
[[nodiscard]] std::string events_csv(const RunReport& report);

}  // namespace kds
