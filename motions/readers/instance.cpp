#include "motions/readers/instance.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "motions/base/input_error.h"
#include "motions/base/input_file.h"
#include "motions/base/text_input.h"
#include "motions/readers/reader_registry.h"

namespace kds {

namespace {

// Parses the three numbers of the first line: points, columns, degree.
std::optional<std::array<std::size_t, 3>> parse_first_line(std::string_view line) {
  const auto fields = split_fields(line);
  if (fields.size() != 3) return std::nullopt;
  std::array<std::size_t, 3> numbers{};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto number = parse_count(fields[i]);
    if (!number) return std::nullopt;
    numbers[i] = *number;
  }
  return numbers;
}

class InstanceReader {
 public:
  InstanceReader(std::string file, std::string_view text) : rest_(text) { instance_.file = std::move(file); }

  Instance read() {
    const std::size_t points = read_first_line();
    const std::size_t numbers =
        static_cast<std::size_t>(instance_.columns) * static_cast<std::size_t>(instance_.degree + 1);
    // A number takes at least two characters, so a wrong count cannot allocate much memory.
    instance_.control_points.reserve(std::min(points, rest_.size() / (2 * numbers) + 1) * numbers);
    for (std::size_t point = 0; point < points; ++point) read_point(point, points, numbers);
    while (!rest_.empty())
      if (const std::string_view line = trimmed(read_line()); !line.empty())
        fail(fmt::format("expected the end of the file after {}, found {}", counted(points, "point"),
                         in_quotes(line)));
    return std::move(instance_);
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    throw InputError(fmt::format("{}:{}: {}", instance_.file, line_number_, message));
  }

  std::string_view read_line() {
    ++line_number_;
    return next_line(rest_);
  }

  std::size_t read_first_line() {
    const std::string_view line = read_line();
    const auto numbers = parse_first_line(line);
    if (!numbers)
      fail(fmt::format("expected 'points columns degree' (three whole numbers), found {}", in_quotes(line)));
    const auto [points, columns, degree] = *numbers;
    if (points < 1) fail("expected at least 1 point, found 0");
    if (columns < 1 || columns > 4) fail(fmt::format("expected 1 to 4 columns, found {}", columns));
    if (degree < 1 || degree > 32) fail(fmt::format("expected a degree from 1 to 32, found {}", degree));
    instance_.columns = static_cast<int>(columns);
    instance_.degree = static_cast<int>(degree);
    return points;
  }

  void read_point(std::size_t point, std::size_t points, std::size_t numbers) {
    if (rest_.empty()) {
      ++line_number_;
      fail(fmt::format("expected {}, found {}", counted(points, "point"), point));
    }
    const auto fields = split_fields(read_line());
    if (fields.size() != numbers)
      fail(fmt::format("expected {}, found {}", counted(numbers, "number"), fields.size()));
    for (const std::string_view field : fields) {
      const auto value = parse_double(field);
      if (!value || !std::isfinite(*value))
        fail(fmt::format("expected a finite number, found {}", in_quotes(field)));
      instance_.control_points.push_back(*value);
    }
  }

  Instance instance_;
  std::string_view rest_;
  std::size_t line_number_ = 0;
};

}  // namespace

Instance read_instance(const std::filesystem::path& path) {
  const std::string text = read_whole_file(path);
  return InstanceReader(path.string(), text).read();
}

bool is_instance_file(const std::filesystem::path& path) {
  if (reader_registry().find_by_ending(path) != nullptr) return false;
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return false;
  std::array<char, 100> start{};
  std::string_view text;
  try {
    InputFile file(path);
    text = {start.data(), file.read(start.data(), start.size())};
    text.remove_prefix(byte_order_mark(text, file.name()));
  } catch (const InputError&) {
    return false;  // reading the file reports the reason
  }
  return parse_first_line(next_line(text)).has_value();
}

}  // namespace kds
