#pragma once
// The results of a run: summary.json, events.csv and report.html in --out, --json, standard output.

#include <optional>
#include <string>
#include <string_view>

#include "experiments/output/destinations.h"
#include "experiments/output/staged_files.h"
#include "experiments/run/events_csv.h"
#include "experiments/run/run_report.h"
#include "motions/scene/scene.h"

namespace kds {

/// Throws InputError where something could not be written later: before a run, not after it.
void check_destinations(const Destinations& destinations);

class RunResults {
 public:
  explicit RunResults(Destinations destinations) : destinations_(std::move(destinations)) {}

  /// The input is accepted: from now on there are files in the making.
  void begin(const Scene& scene);
  /// Events of a structure in the step from that frame on.
  void add_step(const FrameStamp& frame, std::string_view structure, std::uint64_t events);
  /// `json` is the summary; `table` is printed unless quiet, or where standard output is the JSON's. The
  /// files of --out appear together, in place of those of an earlier run. Where the plots fail the figures
  /// are safe, and the page of an earlier run goes.
  void deliver(const RunReport& report, const std::string& json, const std::string& table);

 private:
  Destinations destinations_;
  std::optional<StagedFiles> files_;
  std::optional<EventsCsv> events_;
};

}  // namespace kds
