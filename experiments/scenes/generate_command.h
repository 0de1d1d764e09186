#pragma once
// The options of `kds generate` and their parser.

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "experiments/output/output_files.h"
#include "experiments/program/command_line.h"
#include "motions/models/model.h"

namespace kds {

struct GenerateOptions : Destinations {  // results: generate.json, generate.csv
  const models::Model* model = nullptr;
  models::Settings settings{.frames = 50};  ///< with all values filled in
  std::filesystem::path file;               ///< .xyz, .pdb or .ent

  [[nodiscard]] bool is_pdb() const;
};

/// Parses the options. Throws an InputError that names the option and what it takes. Throws HelpRequest for
/// --help.
[[nodiscard]] GenerateOptions parse_generate_options(const Arguments& arguments);

/// Returns the settings of the model: the option without dashes, and the value as the user would give it.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> model_settings(const GenerateOptions& options);

}  // namespace kds
