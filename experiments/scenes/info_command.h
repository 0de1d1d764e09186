#pragma once
// The options of `kds info`, and the beads that it lists.

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "experiments/output/output_files.h"
#include "experiments/output/table.h"
#include "experiments/program/input_options.h"
#include "experiments/scenes/scene_info.h"
#include "motions/base/bead.h"
#include "motions/frames/trajectory.h"
#include "motions/readers/bead_name.h"
#include "structures/necklace/necklace.h"

namespace kds {

struct InfoOptions : InputOptions, Destinations {  // results: info.json and info.csv
  ValidateOptions validate{.most_listed = 5};
  bool beads = false;                          ///< report only which residue each bead is
  std::optional<std::string> of_trajectories;  ///< an option that is given and has no meaning for instances
};

/// Parses the options. Throws an InputError that names the option and what it takes. Throws HelpRequest for
/// --help. Opens no file.
[[nodiscard]] InfoOptions parse_info_options(const Arguments& arguments);

/// Describes the trajectories of the input. Reads all frames three times. Throws InputError for faults of the
/// input.
[[nodiscard]] SceneInfo describe_input(
    const InfoOptions& options, const std::function<void(std::size_t done, std::size_t total)>& progress,
    const std::function<void(const std::string&)>& warn);

}  // namespace kds
