#pragma once
// Where the results of a command go: files, standard output, the terminal's table.

#include <filesystem>
#include <optional>
#include <string>

namespace kds {

struct Destinations {
  std::optional<std::filesystem::path> out;  ///< directory for the files of a result
  std::optional<std::string> json;           ///< file, or - for standard output
  bool quiet = false;
};

/// Throws OutputError where standard output is closed or full.
void print_to_stdout(const std::string& text);

}  // namespace kds
