#pragma once
// The options of `kds stability`.

#include <string>
#include <vector>

#include "experiments/output/destinations.h"
#include "experiments/program/command_line.h"
#include "experiments/program/option.h"
#include "experiments/stability/stability_subjects.h"

namespace kds {

struct StabilityOptions : Destinations {  // stability.json, stability.csv, report.html
  std::vector<std::string> subjects;      ///< names; empty: all
  std::vector<std::string> extremes;      ///< names or families; empty: all
  StabilityCases cases{1, 200};

  [[nodiscard]] bool wants(const StabilitySubject& subject) const;
  [[nodiscard]] bool wants(const Extreme& extreme) const;
};

[[nodiscard]] const OptionList<StabilityOptions>& stability_options();

/// Throws InputError naming the option and what it takes, HelpRequest for --help.
[[nodiscard]] StabilityOptions parse_stability_options(const Arguments& arguments);

}  // namespace kds
