#pragma once
// `kds stability`: its options, and the run of all requested subjects in all requested extremes.

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "experiments/output/output_files.h"
#include "experiments/program/command_line.h"
#include "experiments/program/option.h"
#include "experiments/stability/stability_subjects.h"

namespace kds {

struct StabilityOptions : Destinations {  // results: stability.json, stability.csv, report.html
  std::vector<std::string> subjects;      ///< names; empty for all
  std::vector<std::string> extremes;      ///< names or families; empty for all
  StabilityCases cases{1, 200};

  [[nodiscard]] bool wants(const StabilitySubject& subject) const;
  [[nodiscard]] bool wants(const Extreme& extreme) const;
};

[[nodiscard]] const OptionList<StabilityOptions>& stability_options();

/// Parses the options. Throws an InputError that names the option and what it takes. Throws HelpRequest for
/// --help.
[[nodiscard]] StabilityOptions parse_stability_options(const Arguments& arguments);

/// `progress` gets the number of rows done and of all rows. Throws InputError if no extreme applies to any
/// subject.
[[nodiscard]] std::vector<StabilityRow> run_stability(
    const StabilityOptions& options, const std::function<void(std::size_t, std::size_t)>& progress);

}  // namespace kds
