#pragma once
// Reads the files of `--dump` into plain tables, and judges only their form.

#include <array>
#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace oracle {

using Cell = std::vector<unsigned>;  ///< one bead for each corner

struct Node {
  unsigned first = 0, last = 0;
  std::vector<unsigned> basis;
  std::array<double, 3> centre{};
  double radius = 0;
};

/// A file whose form differs from the documented format.
struct FormError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

[[nodiscard]] std::filesystem::path dump_file(const std::filesystem::path& dir, std::size_t frame,
                                              const std::string& what);

/// Reads the cells of a diagram in the plane (`space` 2) or in space (3).
[[nodiscard]] std::vector<Cell> read_cells(const std::filesystem::path& path, int space);
[[nodiscard]] std::vector<unsigned> read_hidden(const std::filesystem::path& path);
[[nodiscard]] std::vector<Node> read_nodes(const std::filesystem::path& path);

void write_cells(const std::filesystem::path& path, const std::vector<Cell>& cells, int space);
void write_hidden(const std::filesystem::path& path, const std::vector<unsigned>& hidden);
void write_nodes(const std::filesystem::path& path, const std::vector<Node>& nodes);

}  // namespace oracle
