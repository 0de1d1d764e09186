#pragma once
// The project's data, from which some commands take their inputs.

#include <filesystem>
#include <string_view>

#include "experiments/program/option.h"

namespace kds {

/// The folder data of the source tree that the program was built from.
[[nodiscard]] std::filesystem::path source_data_folder();

/// --data. The member's default is source_data_folder(). Not a setting of the JSON.
template <class Options>
[[nodiscard]] Option<Options> data_option(std::filesystem::path Options::*data) {
  return of_output(path_option(
      {"--data", "DIR", "the project's data folder (default: that of the sources of this program)"}, data));
}

/// Returns a folder of the data. Throws InputError if it is missing; `instead` names an option that gives the
/// inputs directly.
std::filesystem::path folder_in_data(const std::filesystem::path& data, const char* name,
                                     std::string_view instead = "");

}  // namespace kds
