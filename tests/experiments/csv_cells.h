#pragma once
// Reads tables that the program writes.

#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "tests/experiments/scratch_directory.h"

namespace kds::test {

/// Returns the cells of each line of a CSV file, without its header. No cell of the file may be quoted.
[[nodiscard]] inline std::vector<std::vector<std::string>> csv_cells(const std::filesystem::path& path) {
  std::vector<std::vector<std::string>> lines;
  const std::string text = content_of(path);
  std::istringstream stream(text.substr(text.find('\n') + 1));
  for (std::string line; std::getline(stream, line);) {
    std::istringstream cells(line);
    lines.emplace_back();
    for (std::string cell; std::getline(cells, cell, ',');) lines.back().push_back(cell);
  }
  return lines;
}

}  // namespace kds::test
