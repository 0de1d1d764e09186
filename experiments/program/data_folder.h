#pragma once
// Locates the project's data folder, from which some commands take their inputs.

#include <filesystem>
#include <string_view>

#include "experiments/program/option.h"

namespace kds {

/// Returns the folder `data` of the source tree from which the program was built.
[[nodiscard]] std::filesystem::path source_data_folder();

/// Returns the option --data. The default of the member is source_data_folder(). JSON results do not list
/// --data as a setting.
template <class Options>
[[nodiscard]] Option<Options> data_option(std::filesystem::path Options::*data) {
  return of_output(path_option(
      {"--data", "DIR", "the project's data folder (default: that of the sources of this program)"}, data));
}

/// Returns the path of a folder inside the data folder. Throws InputError if the folder is missing; `instead`
/// names an option that gives the inputs directly.
std::filesystem::path folder_in_data(const std::filesystem::path& data, const char* name,
                                     std::string_view instead = "");

}  // namespace kds
