#pragma once
// The options of `kds compare` and their parser.

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "experiments/output/output_files.h"
#include "experiments/program/input_options.h"
#include "motions/base/bead.h"
#include "motions/scene/scene.h"

namespace kds {

/// Each input is a separate run. The results are compare.json, compare.csv and report.html.
struct CompareOptions : InputOptions, Destinations {
  std::vector<std::string> structures;  ///< in the order of the registry; empty for the input's default
  std::vector<std::size_t> strides{1};  ///< ascending
  std::vector<FrameMotion> motions{FrameMotion::linear};
  std::size_t rounds = 3;                     ///< timed repetitions of each run
  std::optional<BeadId> apart;                ///< --apart
  std::optional<int> directions;              ///< --directions
  std::optional<double> stretch;              ///< --stretch
  std::optional<double> probe;                ///< --probe
  std::optional<std::size_t> threads;         ///< --threads; empty for all cores
  std::optional<std::filesystem::path> view;  ///< page that shows the first run
};

/// Parses the options. Throws an InputError that names the option and what it takes. Throws HelpRequest for
/// --help. Opens no file.
[[nodiscard]] CompareOptions parse_compare_options(const Arguments& arguments);

}  // namespace kds
