#pragma once
// The results of a run: summary.json, events.csv and report.html in --out, --json, standard output.

#include <string>

#include "experiments/output/destinations.h"
#include "experiments/run/run_report.h"

namespace kds {

/// Throws InputError where something could not be written later: before a run, not after it.
void check_destinations(const Destinations& destinations);

/// `json` is the summary; `table` is printed unless quiet, or where standard output is the JSON's.
void deliver(const Destinations& destinations, const RunReport& report, const std::string& json,
             const std::string& table);

}  // namespace kds
