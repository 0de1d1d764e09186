#pragma once
// `kds update`: what it was asked to do, and how that is parsed.

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/output/destinations.h"
#include "experiments/program/input_options.h"
#include "kds/audit.h"
#include "structures/power_diagram/update_technique.h"

namespace kds {

/// All techniques by name, in the order in which they are listed: those of
/// structures/power_diagram/diagram_update.h, and the kinetic one under Hermite motion. The first is what all
/// are compared with.
inline constexpr auto kTechniques = [] {
  std::array<std::string_view, update_technique_names.size() + 1> names;
  std::size_t count = 0;
  for (const std::string_view name : update_technique_names) {
    names[count++] = name;
    if (name == name_of(UpdateTechnique::kinetic)) names[count++] = "hermite";
  }
  return names;
}();

struct UpdateOptions : InputOptions, Destinations {  // update.json, update.csv, report.html
  std::vector<std::string> techniques{kTechniques.begin(), kTechniques.end()};  ///< rebuild among them
  std::vector<std::size_t> strides{1};                                          ///< ascending
  std::size_t rounds = 3;
  AuditMode audit = AuditMode::none;  ///< none or frames
};

[[nodiscard]] const OptionList<UpdateOptions>& update_options();

/// Throws InputError naming the option and what it takes, HelpRequest for --help. Opens no file.
[[nodiscard]] UpdateOptions parse_update_options(const Arguments& arguments);

}  // namespace kds
