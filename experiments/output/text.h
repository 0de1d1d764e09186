#pragma once
// Small pieces of text that messages, tables and pages share. None of it asks the locale.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace kds {

/// 1234567 as 1,234,567.
[[nodiscard]] std::string with_thousands(std::uint64_t value);

/// A field of CSV: the value as it reads back, nothing where there is none.
[[nodiscard]] std::string value_or_empty(const std::optional<double>& value);
[[nodiscard]] std::string value_or_empty(const std::optional<std::uint64_t>& value);

/// Seconds or a ratio with about four figures; never an exponent.
[[nodiscard]] std::string short_decimal(double value);

/// A value as plots have it at their ticks: 12,000, 0.25, 3·10⁻⁷.
[[nodiscard]] std::string tick_label(double value);

/// A fingerprint as it is printed everywhere: 16 hex digits.
[[nodiscard]] std::string hex_digits(std::uint64_t value);

/// Control characters replaced by spaces, so that a message stays one line whatever name it quotes.
[[nodiscard]] std::string one_line(std::string_view text);

/// Words as a shell reads them back.
[[nodiscard]] std::string shell_words(const std::vector<std::string>& words);

/// Lines of cells, all of as many: each column as wide as its widest cell, two spaces between, none at the
/// end. `alignment` has '<' (left) or '>' for each column, the last of them for those after it too.
[[nodiscard]] std::vector<std::string> in_columns(const std::vector<std::vector<std::string>>& lines,
                                                  std::string_view alignment);

/// The parts between separators, empty ones too; an empty text has one empty part.
[[nodiscard]] std::vector<std::string> split(std::string_view text, char separator);

}  // namespace kds
