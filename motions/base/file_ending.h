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

/// Whether PDB files with this ending hold a biological assembly: .pdb and a number, as .pdb1.
[[nodiscard]] inline bool is_assembly_ending(const std::string& ending) {
  return ending.size() > 4 && ending.compare(0, 4, ".pdb") == 0 &&
         ending.find_first_not_of("0123456789", 4) == std::string::npos;
}

}  // namespace kds
