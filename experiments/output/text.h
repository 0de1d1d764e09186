#pragma once
// Text helpers that messages and tables share. The helpers are independent of the locale.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace kds {

/// Returns 1234567 as 1,234,567.
[[nodiscard]] std::string with_thousands(std::uint64_t value);

/// Returns seconds or a ratio with about four figures. From 1e-9 to 1e15 there is no exponent, so the cells
/// of a row have one notation.
[[nodiscard]] std::string short_decimal(double value);

/// Returns a fingerprint as 16 hex digits, the form in which all outputs print it.
[[nodiscard]] std::string hex_digits(std::uint64_t value);

/// Replaces control characters by spaces. A message therefore stays on one line whatever name it quotes.
[[nodiscard]] std::string one_line(std::string_view text);

/// Returns the words quoted so that a shell reads them back.
[[nodiscard]] std::string shell_words(const std::vector<std::string>& words);

/// Aligns lines of cells, all with the same number of cells. Each column is as wide as its widest cell, with
/// two spaces between columns and none at the end. `alignment` has '<' (left) or '>' (right) for each column.
/// The last character of `alignment` also holds for all further columns.
[[nodiscard]] std::vector<std::string> in_columns(const std::vector<std::vector<std::string>>& lines,
                                                  std::string_view alignment);

/// Returns the parts between separators, including empty parts. An empty text has one empty part.
[[nodiscard]] std::vector<std::string> split(std::string_view text, char separator);

}  // namespace kds
