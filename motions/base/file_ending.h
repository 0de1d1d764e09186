#pragma once
// A file's ending, which determines its format; upper and lower case are equivalent.

#include <filesystem>
#include <string>

namespace kds {

/// Returns the ending in lower case with its dot: ".pdb".
[[nodiscard]] inline std::string file_ending(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  for (char& c : ending)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return ending;
}

/// Returns whether PDB files with this ending hold a biological assembly: .pdb and a number, as in .pdb1.
[[nodiscard]] inline bool is_assembly_ending(const std::string& ending) {
  return ending.size() > 4 && ending.compare(0, 4, ".pdb") == 0 &&
         ending.find_first_not_of("0123456789", 4) == std::string::npos;
}

}  // namespace kds
