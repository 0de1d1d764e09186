#include "experiments/program/data_folder.h"

#include <fmt/format.h>

#include "motions/base/input_error.h"

namespace kds {

std::filesystem::path data_folder(const ParsedArguments& parsed) {
  return parsed.value("--data").value_or(KDS_SOURCE_DATA_DIR);
}

std::filesystem::path data_folder(const ParsedArguments& parsed,
                                  std::initializer_list<const char*> needed_folders) {
  const std::filesystem::path data = data_folder(parsed);
  std::error_code none;
  for (const char* folder : needed_folders)
    if (!std::filesystem::is_directory(data / folder, none))
      throw InputError(fmt::format("--data: there is no folder {}; expected the folder data of the sources",
                                   (data / folder).string()));
  return data;
}

}  // namespace kds
