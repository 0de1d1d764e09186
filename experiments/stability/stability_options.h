#pragma once
// What `kds stability` was asked to do.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "experiments/stability/stability_subjects.h"

namespace kds {

struct StabilityOptions {
  std::vector<std::string> subjects;  ///< names; empty: all
  std::vector<std::string> extremes;  ///< names or families; empty: all
  StabilityCases cases{1, 200};
  std::optional<std::filesystem::path> out;  ///< directory for stability.json, stability.csv, report.html
  std::optional<std::string> json;           ///< file, or - for standard output
  bool quiet = false;

  [[nodiscard]] bool wants(const StabilitySubject& subject) const;
  [[nodiscard]] bool wants(const Extreme& extreme) const;
};

}  // namespace kds
