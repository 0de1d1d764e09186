#pragma once
// Files of queries of continuous collision, as the public collections have them
// (https://github.com/Continuous-Collision-Detection/Sample-Queries). Each query is eight lines: four points
// at time 0, then the same points at time 1. A line has the numerators and denominators of x, y and z, and at
// the end, if the answer is known, 1 if the two features meet at some time and 0 if not. Plain or gzipped.

#include <array>
#include <filesystem>
#include <optional>

#include "motions/base/input_file.h"

namespace kds {

struct ImpactQuery {
  /// Control points as ImpactSearch takes them: of each point x, y and z at time 0, then at time 1.
  std::array<double, 24> points{};
  std::optional<bool> answer;  ///< whether the features meet, if the file says so
};

class QueryFile {
 public:
  /// Opens the file. Throws InputError naming the file.
  explicit QueryFile(const std::filesystem::path& path) : lines_(path) {}

  /// Reads the next query. Returns false at the end of the file. Throws InputError naming file and line if a
  /// line is not as above, if a value is not exactly a double, or if the file ends within a query.
  [[nodiscard]] bool next(ImpactQuery& query);

 private:
  [[noreturn]] void fail(std::string_view expected, std::string_view found) const;
  /// Parses a line; returns its answer.
  [[nodiscard]] std::optional<bool> parse(std::string_view line, double* point) const;

  LineReader lines_;
};

}  // namespace kds
