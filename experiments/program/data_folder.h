#pragma once
// The project's data, which some commands take their inputs from.

#include <filesystem>

#include "experiments/program/command_line.h"

namespace kds {

/// What --data gives, else the folder data of the sources that the program was built from.
[[nodiscard]] std::filesystem::path data_folder(const ParsedArguments& parsed);

}  // namespace kds
