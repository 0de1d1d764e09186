#pragma once
// Moving points of a Bezier instance file: one step u in [0,1], control points exact in double.
//
// File: a line `n columns degree`, then one line per point, with degree+1 control points for each column.
// One to three columns are coordinates; a fourth is the weight (squared radius) of a point in space.

#include <filesystem>
#include <string>
#include <vector>

namespace kds {

struct Instance {
  std::string file;
  int columns = 0;                     ///< 1..4
  int degree = 0;                      ///< degree of every column, at least 1
  std::vector<double> control_points;  ///< [point][column][0..degree]

  [[nodiscard]] int dimension() const { return columns < 3 ? columns : 3; }
  [[nodiscard]] bool weighted() const { return columns == 4; }
  [[nodiscard]] std::size_t point_count() const {
    return columns == 0 ? 0 : control_points.size() / static_cast<std::size_t>(columns * (degree + 1));
  }
  [[nodiscard]] double control_point(std::size_t point, int column, int k) const {
    return control_points[(point * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column)) *
                              static_cast<std::size_t>(degree + 1) +
                          static_cast<std::size_t>(k)];
  }
};

/// Reads an instance. Throws InputError naming file and line.
[[nodiscard]] Instance read_instance(const std::filesystem::path& path);

/// Returns whether the file's first line has the form of an instance file (three whole numbers, nothing
/// else).
[[nodiscard]] bool is_instance_file(const std::filesystem::path& path);

}  // namespace kds
