#include "motions/base/text_input.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <memory>

#include "motions/base/input_error.h"

namespace kds {

std::string read_whole_file(const std::filesystem::path& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
    throw InputError(fmt::format("{}: this is a folder, expected a file", path.string()));
  // zlib hands through what is not compressed.
  const std::unique_ptr<gzFile_s, int (*)(gzFile)> file(gzopen(path.c_str(), "rb"), gzclose);
  if (!file) throw InputError(fmt::format("{}: cannot open this file", path.string()));
  std::string text;
  std::array<char, 1 << 16> piece;
  for (;;) {
    const int got = gzread(file.get(), piece.data(), static_cast<unsigned>(piece.size()));
    if (got > 0) text.append(piece.data(), static_cast<std::size_t>(got));
    if (got == static_cast<int>(piece.size())) continue;
    int code = Z_OK;
    const char* why = gzerror(file.get(), &code);
    if (got < 0 || (code != Z_OK && code != Z_STREAM_END))
      throw InputError(fmt::format("{}: cannot read this file ({})", path.string(), why));
    if (got == 0) return text;
  }
}

std::string_view next_line(std::string_view& rest) {
  const std::size_t end = rest.find('\n');
  std::string_view line = rest.substr(0, end);
  rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

namespace {
constexpr std::string_view blanks = " \t\r\v\f";
}

std::vector<std::string_view> split_fields(std::string_view line) {
  std::vector<std::string_view> fields;
  for (std::size_t begin = line.find_first_not_of(blanks); begin != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(blanks, begin), line.size());
    fields.push_back(line.substr(begin, end - begin));
    begin = line.find_first_not_of(blanks, end);
  }
  return fields;
}

std::string_view trimmed(std::string_view field) {
  const std::size_t begin = field.find_first_not_of(blanks);
  if (begin == std::string_view::npos) return {};
  return field.substr(begin, field.find_last_not_of(blanks) - begin + 1);
}

std::optional<double> parse_double(std::string_view field) {
  if (field.starts_with('+') && field.size() > 1 && field[1] != '-') field.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error == std::errc::result_out_of_range && end == field.data() + field.size()) {
    // Too small is zero, or nearly: the C library tells which; too large stays an error.
    const double nearest = std::strtod(std::string(field).c_str(), nullptr);
    if (std::isfinite(nearest)) return nearest;
  }
  if (error != std::errc{} || end != field.data() + field.size()) return std::nullopt;
  return value;
}

std::optional<std::size_t> parse_count(std::string_view field) {
  std::size_t value = 0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error != std::errc{} || end != field.data() + field.size()) return std::nullopt;
  return value;
}

std::string in_quotes(std::string_view field) {
  constexpr std::size_t longest = 40;
  std::string text = "'";
  for (const char c : field.substr(0, longest)) text += c >= ' ' && c <= '~' ? c : '?';
  return text + (field.size() > longest ? "...'" : "'");
}

std::string counted(std::size_t count, std::string_view noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

}  // namespace kds
