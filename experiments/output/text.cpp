#include "experiments/output/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace kds {

std::string with_thousands(std::uint64_t value) {
  std::string digits = fmt::format("{}", value);
  for (std::size_t offset = digits.size(); offset > 3;) {
    offset -= 3;
    digits.insert(offset, 1, ',');
  }
  return digits;
}

std::string short_decimal(double value) {
  if (!std::isfinite(value)) return "-";
  const double size = std::abs(value);
  if (size == 0) return "0";
  if (size >= 1e15) return fmt::format("{:.3e}", value);  // unrealistic, but a line keeps its width
  if (size >= 1000) {
    const std::string digits = with_thousands(static_cast<std::uint64_t>(std::llround(size)));
    return fmt::format("{}{}", value < 0 ? "-" : "", digits);
  }
  if (size >= 100) return fmt::format("{:.1f}", value);
  if (size >= 10) return fmt::format("{:.2f}", value);
  if (size >= 0.01) return fmt::format("{:.3f}", value);
  if (size >= 1e-4) return fmt::format("{:.6f}", value);
  if (size >= 1e-9) return fmt::format("{:.{}f}", value, 3 - static_cast<int>(std::floor(std::log10(size))));
  return fmt::format("{:.3e}", value);  // only errors of rounding are so small
}

std::string hex_digits(std::uint64_t value) { return fmt::format("{:016x}", value); }

std::string one_line(std::string_view text) {
  std::string line(text);
  for (char& c : line) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7f) c = ' ';
  }
  while (!line.empty() && line.back() == ' ') line.pop_back();
  return line;
}

std::string shell_words(const std::vector<std::string>& words) {
  constexpr std::string_view plain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=:,./@";
  std::string text;
  for (const std::string& word : words) {
    if (!text.empty()) text += ' ';
    if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) {
      text += word;
      continue;
    }
    text += '\'';
    for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
    text += '\'';
  }
  return text;
}

std::vector<std::string> in_columns(const std::vector<std::vector<std::string>>& lines,
                                    std::string_view alignment) {
  std::vector<std::size_t> widths(lines.empty() ? 0 : lines.front().size(), 0);
  for (const std::vector<std::string>& line : lines)
    for (std::size_t c = 0; c < line.size(); ++c) widths[c] = std::max(widths[c], line[c].size());
  std::vector<std::string> aligned;
  for (const std::vector<std::string>& line : lines) {
    std::string text;
    for (std::size_t c = 0; c < line.size(); ++c) {
      if (c > 0) text += "  ";
      const bool left = alignment[std::min(c, alignment.size() - 1)] == '<';
      text += left ? fmt::format("{:<{}}", line[c], widths[c]) : fmt::format("{:>{}}", line[c], widths[c]);
    }
    aligned.push_back(text.substr(0, text.find_last_not_of(' ') + 1));
  }
  return aligned;
}

std::vector<std::string> split(std::string_view text, char separator) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == separator) {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

}  // namespace kds
