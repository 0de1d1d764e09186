#pragma once
// Reads text files and the numbers in them. A number must fill its whole field, otherwise it does not parse.

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace kds {

/// The most bytes that read_whole_file reads. Files of frames are read line by line and have no such limit.
inline constexpr std::size_t most_whole = std::size_t{1} << 30U;

/// Returns the whole file, unpacked if it is gzipped, without a byte order mark. Throws InputError naming the
/// file if it cannot be read or holds more than `most_whole` bytes.
[[nodiscard]] std::string read_whole_file(const std::filesystem::path& path);

/// Makes every line end LF: CR LF, and CR by itself.
void unify_line_ends(std::string& text);

/// Cuts the next line off `rest` and returns it without its line end, LF or CR LF.
[[nodiscard]] std::string_view next_line(std::string_view& rest);

/// Returns the fields of a line, separated by blanks and tabs.
[[nodiscard]] std::vector<std::string_view> split_fields(std::string_view line);

[[nodiscard]] std::string_view trimmed(std::string_view field);

/// Parses a decimal number and returns the nearest double, which may be 0. "nan" and "inf" are accepted.
/// Returns nothing if the field is not a number or exceeds the range of double.
[[nodiscard]] std::optional<double> parse_double(std::string_view field);

/// Parses a nonnegative whole number.
[[nodiscard]] std::optional<std::size_t> parse_count(std::string_view field);

/// Returns a field as messages show it: short, in quotes, without control characters.
[[nodiscard]] std::string in_quotes(std::string_view field);

/// Returns a count with its noun: "1 atom", "2 atoms".
[[nodiscard]] std::string counted(std::size_t count, std::string_view noun);

}  // namespace kds
