#pragma once
// Reads text files and the numbers in them. A number must take up its whole field; anything else is no
// number.

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace kds {

/// What read_whole_file reads at most; files of frames are read line by line and have no such limit.
inline constexpr std::size_t most_whole = std::size_t{1} << 30U;

/// The whole file, unpacked if it is gzipped, without a byte order mark. Throws InputError naming the file,
/// also if it holds more than `most_whole` bytes.
[[nodiscard]] std::string read_whole_file(const std::filesystem::path& path);

/// Cuts the next line off `rest` and returns it without its line end, LF or CR LF.
[[nodiscard]] std::string_view next_line(std::string_view& rest);

/// The fields of a line, which blanks and tabs separate.
[[nodiscard]] std::vector<std::string_view> split_fields(std::string_view line);

[[nodiscard]] std::string_view trimmed(std::string_view field);

/// The double nearest to a decimal number, 0 too where none is nearer; "nan" and "inf" count as numbers here,
/// one too large for a double does not.
[[nodiscard]] std::optional<double> parse_double(std::string_view field);

/// A whole number from 0 on.
[[nodiscard]] std::optional<std::size_t> parse_count(std::string_view field);

/// A field as it may stand in a message: short, in quotes, without control characters.
[[nodiscard]] std::string in_quotes(std::string_view field);

/// "1 atom", "2 atoms".
[[nodiscard]] std::string counted(std::size_t count, std::string_view noun);

}  // namespace kds
