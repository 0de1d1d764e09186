#pragma once
// The project's data, which some commands take their inputs from.

#include <filesystem>
#include <initializer_list>

#include "experiments/program/command_line.h"

namespace kds {

/// What --data gives, else the folder data of the sources that the program was built from.
[[nodiscard]] std::filesystem::path data_folder(const ParsedArguments& parsed);
/// The same, refused where a folder of it that is needed is missing.
[[nodiscard]] std::filesystem::path data_folder(const ParsedArguments& parsed,
                                                std::initializer_list<const char*> needed_folders);

}  // namespace kds
