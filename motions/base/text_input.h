#pragma once
// Text: reads text files and the numbers in them, quotes fields for messages and CSV files, compares names.
// A number must fill its whole field, otherwise it does not parse.

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

/// Returns the text with its ASCII letters in lower case, in every locale.
[[nodiscard]] inline std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return lower;
}

/// Returns the ending of a file in lower case with its dot: ".pdb".
[[nodiscard]] inline std::string file_ending(const std::filesystem::path& path) {
  return lower_case(path.extension().string());
}

/// Returns whether PDB files with this ending hold a biological assembly: .pdb and a number, as in .pdb1.
[[nodiscard]] inline bool is_assembly_ending(const std::string& ending) {
  return ending.size() > 4 && ending.compare(0, 4, ".pdb") == 0 &&
         ending.find_first_not_of("0123456789", 4) == std::string::npos;
}

/// Returns the text as a field of a CSV file (comma-separated values), in quotation marks if necessary.
[[nodiscard]] inline std::string csv_field(std::string_view text) {
  if (text.find_first_of(",\"\n\r") == std::string_view::npos) return std::string(text);
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += c;
    quoted += c;
  }
  return quoted + '"';
}

/// Returns how many insertions, deletions, substitutions and exchanges of neighbours make `b` of `a`: the
/// Damerau-Levenshtein distance in which no letter is edited twice (optimal string alignment). The distance
/// finds mistyped names.
[[nodiscard]] std::size_t edit_distance(std::string_view a, std::string_view b);

}  // namespace kds
