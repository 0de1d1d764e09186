#pragma once
// The options, the measurements and the report of `kds update`.

#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/output/output_files.h"
#include "experiments/output/table.h"
#include "experiments/program/input_options.h"
#include "kds/kinetic_structure.h"
#include "motions/scene/scene.h"
#include "structures/power_diagram/diagram_update.h"

namespace kds {

/// The names of all techniques in the order of listing: the techniques of
/// structures/power_diagram/diagram_update.h, and the kinetic technique under Hermite motion. All techniques
/// are compared with the first.
inline constexpr auto kTechniques = [] {
  std::array<std::string_view, update_technique_names.size() + 1> names;
  std::size_t count = 0;
  for (const std::string_view name : update_technique_names) {
    names[count++] = name;
    if (name == name_of(UpdateTechnique::kinetic)) names[count++] = "hermite";
  }
  return names;
}();

struct UpdateOptions : InputOptions, Destinations {  // results: update.json, update.csv, report.html
  std::vector<std::string> techniques{kTechniques.begin(), kTechniques.end()};  ///< always contains rebuild
  std::vector<std::size_t> strides{1};                                          ///< ascending
  std::size_t rounds = 3;
  AuditMode audit = AuditMode::none;  ///< none or frames
};

[[nodiscard]] const OptionList<UpdateOptions>& update_options();

/// Parses the options. Throws an InputError that names the option and what it takes. Throws HelpRequest for
/// --help. Opens no file.
[[nodiscard]] UpdateOptions parse_update_options(const Arguments& arguments);

struct UpdateRow;  // compare_updates.h

/// Reads the inputs, once for each stride, and compares the techniques. `look_at` is called with the scene of
/// all frames before the first run. Each warning goes to `warn` as one line. Throws InputError.
[[nodiscard]] std::vector<UpdateRow> measure_updates(
    const UpdateOptions& options, const std::function<void(std::size_t, std::size_t)>& progress,
    const std::function<void(const std::string&)>& warn,
    const std::function<void(const Scene& all)>& look_at = {});

/// Returns the columns of update.json and update.csv and of the terminal.
[[nodiscard]] const Table<UpdateRow>& update_columns();
/// Returns a line for each stride, followed by a line for each technique.
[[nodiscard]] std::string update_table(std::span<const UpdateRow> rows);

}  // namespace kds
