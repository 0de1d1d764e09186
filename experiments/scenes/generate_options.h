#pragma once
// `kds generate`: what it was asked to do, and how that is parsed.

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "experiments/output/destinations.h"
#include "experiments/program/command_line.h"
#include "motions/models/model.h"

namespace kds {

struct GenerateOptions : Destinations {  // generate.json, generate.csv
  const models::Model* model = nullptr;
  models::Settings settings{.frames = 50};  ///< complete
  std::filesystem::path file;               ///< .xyz, .pdb or .ent

  [[nodiscard]] bool is_pdb() const;
};

/// Throws InputError naming the option and what it takes, HelpRequest for --help.
[[nodiscard]] GenerateOptions parse_generate_options(const Arguments& arguments);

/// What the model takes, by option without dashes, as the user would give it.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> model_settings(const GenerateOptions& options);

}  // namespace kds
