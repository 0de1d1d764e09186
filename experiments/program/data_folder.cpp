#include "experiments/program/data_folder.h"

#include <fmt/format.h>

#include "motions/base/input_error.h"

namespace kds {

std::filesystem::path source_data_folder() { return KDS_SOURCE_DATA_DIR; }

std::filesystem::path folder_in_data(const std::filesystem::path& data, const char* name,
                                     std::string_view instead) {
  std::error_code none;
  if (std::filesystem::is_directory(data / name, none)) return data / name;
  throw InputError(fmt::format("--data: there is no folder {}; expected the folder data of the sources{}{}",
                               (data / name).string(), instead.empty() ? "" : ", or inputs with ", instead));
}

}  // namespace kds
