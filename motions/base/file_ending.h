#pragma once
// A file's format is told by its ending, in either case.

#include <filesystem>
#include <string>

namespace kds {

/// In lower case, with its dot: ".pdb".
[[nodiscard]] inline std::string file_ending(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  for (char& c : ending)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return ending;
}

}  // namespace kds
