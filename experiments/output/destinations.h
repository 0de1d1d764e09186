#pragma once
// The destinations of a command's results: files, standard output and the table on the terminal.

#include <filesystem>
#include <optional>
#include <string>

namespace kds {

struct Destinations {
  std::optional<std::filesystem::path> out;  ///< directory for the result files
  std::optional<std::string> json;           ///< a file, or - for standard output
  bool quiet = false;
};

/// Throws OutputError if standard output is closed or full.
void print_to_stdout(const std::string& text);

}  // namespace kds
