#pragma once
// Where the results of a command go: files, standard output, the terminal's table.

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "experiments/run/run_report.h"

namespace kds {

struct Destinations {
  std::optional<std::filesystem::path> out;  ///< directory for summary.json, events.csv, report.html
  std::optional<std::string> json;           ///< file, or - for standard output
  bool quiet = false;
};

/// Throws InputError where something could not be written later: before a run, not after it.
void check_destinations(const Destinations& destinations);

/// `json` is the summary; `table` is printed unless quiet, or where standard output is the JSON's.
void deliver(const Destinations& destinations, const RunReport& report, const std::string& json,
             const std::string& table);

/// Throws OutputError where standard output is closed or full.
void print_to_stdout(const std::string& text);

}  // namespace kds
