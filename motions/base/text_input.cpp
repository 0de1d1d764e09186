#include "motions/base/text_input.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <locale>
#include <sstream>
#include <vector>

#include "motions/base/input_error.h"
#include "motions/base/input_file.h"

namespace kds {

std::string read_whole_file(const std::filesystem::path& path) {
  InputFile file(path);
  std::string text;
  std::array<char, 1 << 16> piece;
  std::size_t line = 0;  // number of characters since the last line end
  while (const std::size_t got = file.read(piece.data(), piece.size())) {
    const std::string_view now(piece.data(), got);
    const std::size_t last = now.find_last_of("\r\n");
    line = last == std::string_view::npos ? line + got : got - last - 1;
    if (line > LineReader::longest)
      throw InputError(fmt::format("{}: a line is longer than {} characters, the limit of this format",
                                   path.string(), LineReader::longest));
    text.append(now);
    if (text.size() > most_whole)
      throw InputError(
          fmt::format("{}: holds more than {} bytes, the limit for such a file", path.string(), most_whole));
  }
  text.erase(0, byte_order_mark(text, path.string()));
  return text;
}

void unify_line_ends(std::string& text) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool before_lf = text[i] == '\r' && i + 1 < text.size() && text[i + 1] == '\n';
    if (!before_lf) text[kept++] = text[i] == '\r' ? '\n' : text[i];
  }
  text.resize(kept);
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
    // If a number is too small, let a stream round it to zero or a subnormal, independently of the host
    // program's locale. A number that is too large remains an error.
    std::istringstream text{std::string(field)};
    text.imbue(std::locale::classic());
    if (text >> value && std::isfinite(value)) return value;
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

std::size_t edit_distance(std::string_view a, std::string_view b) {
  // Rows of the last three prefixes of `a`.
  std::vector<std::size_t> before(b.size() + 1), row(b.size() + 1), next(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    next[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      next[j] = std::min({row[j] + 1, next[j - 1] + 1, row[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        next[j] = std::min(next[j], before[j - 2] + 1);
    }
    before.swap(row);
    row.swap(next);
  }
  return row.back();
}

}  // namespace kds
