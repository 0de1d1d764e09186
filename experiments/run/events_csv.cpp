#include "experiments/run/events_csv.h"

#include <fmt/format.h>

#include <iterator>
#include <vector>

#include "experiments/run/summary_rows.h"

namespace kds {

std::string events_csv(const RunReport& report) {
  const bool timed = !report.times.empty();
  std::string text =
      timed ? "frame,structure,events,cumulative,picoseconds\n" : "frame,structure,events,cumulative\n";
  std::vector<std::uint64_t> cumulative(report.structures.size(), 0);
  for (std::size_t step = 0; step < step_count(report); ++step) {
    for (std::size_t i = 0; i < report.structures.size(); ++i) {
      const StructureReport& structure = report.structures[i];
      if (step >= structure.events_per_step.size()) continue;
      cumulative[i] += structure.events_per_step[step];
      text += fmt::format("{},{},{},{}", frame_number(report, step), structure.name,
                          structure.events_per_step[step], cumulative[i]);
      if (timed) text += fmt::format(",{:.10g}", report.times[step]);
      text += '\n';
    }
  }
  return text;
}

}  // namespace kds
