#pragma once
// The options of `kds voids` and its results as they are written.

#include <filesystem>
#include <optional>
#include <string>

#include "experiments/output/output_files.h"
#include "experiments/output/result_json.h"
#include "experiments/program/command_line.h"
#include "experiments/voids/follow_voids.h"

namespace kds {

struct VoidsOptions {
  VoidsTask task;
  Destinations destinations;
  std::optional<std::filesystem::path> view;  ///< page that shows the complex and its voids
};

/// Parses the options. Throws an InputError that names the option and what it takes. Throws HelpRequest for
/// --help. Opens no file.
[[nodiscard]] VoidsOptions parse_voids_options(const Arguments& arguments);

/// Adds the results to `json`, as docs/formats.md lists them.
void add_voids(const VoidsReport& report, Json& json);
/// Returns what the command prints: the cavities that are closed longest, and how long cavities last.
[[nodiscard]] std::string voids_text(const VoidsReport& report);

}  // namespace kds
