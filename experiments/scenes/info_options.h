#pragma once
// `kds info`: what it was asked to do, and how that is parsed.

#include <filesystem>
#include <optional>
#include <string>

#include "experiments/program/command_line.h"
#include "experiments/program/input_options.h"
#include "structures/necklace/necklace.h"

namespace kds {

struct InfoOptions {
  InputOptions input;
  ValidateOptions validate{.most_listed = 5};
  bool beads = false;                        ///< which residue each bead is, and nothing else
  std::optional<std::filesystem::path> out;  ///< directory for info.json, info.csv
  std::optional<std::string> json;           ///< file, or - for standard output
  bool quiet = false;
};

/// Throws InputError naming the option and what it takes, HelpRequest for --help. Opens no file.
[[nodiscard]] InfoOptions parse_info_options(const Arguments& arguments);

}  // namespace kds
