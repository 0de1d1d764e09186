#include "experiments/program/data_folder.h"

namespace kds {

std::filesystem::path data_folder(const ParsedArguments& parsed) {
  return parsed.value("--data").value_or(KDS_SOURCE_DATA_DIR);
}

}  // namespace kds
