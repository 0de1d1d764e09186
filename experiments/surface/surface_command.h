#pragma once
// The options of `kds surface`, and its results as they are written.

#include <string>

#include "experiments/output/output_files.h"
#include "experiments/output/result_json.h"
#include "experiments/program/command_line.h"
#include "experiments/surface/measure_surface.h"

namespace kds {

struct SurfaceOptions {
  SurfaceTask task;
  Destinations destinations;
};

/// Parses the options. Throws an InputError that names the option and what it takes. Throws HelpRequest for
/// --help. Opens no file.
[[nodiscard]] SurfaceOptions parse_surface_options(const Arguments& arguments);

/// Adds the members of surface.json to `json`.
void add_surface(const SurfaceReport& report, Json& json);
/// Returns the tables on the terminal: totals, the residues with the largest areas, and pairs of chains.
[[nodiscard]] std::string surface_text(const SurfaceReport& report);

}  // namespace kds
