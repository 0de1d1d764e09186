#pragma once
// Parses the values of options. Each function throws an InputError that names the option, the text found and
// what is expected.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "motions/base/input_error.h"

namespace kds {

/// Throws InputError: the word is not one of the names. Suggests the nearest of them. `expected` is the end
/// of the sentence "'WORD' is not ..." where a list of the names does not say it.
[[noreturn]] void refuse_unknown(std::string_view option, std::string_view word,
                                 std::span<const std::string_view> names, std::string_view expected = "");

/// The place of a word among several names.
[[nodiscard]] std::size_t place_among(std::string_view option, std::string_view word,
                                      std::span<const std::string_view> names);

/// An enumerator by its name. `names` are those of the enumerators from `first` on.
template <class Enum>
[[nodiscard]] Enum choice_of(std::string_view option, std::string_view word,
                             std::span<const std::string_view> names, Enum first = Enum{}) {
  return static_cast<Enum>(static_cast<std::size_t>(first) + place_among(option, word, names));
}

/// The path of a file or directory; - is refused.
[[nodiscard]] std::filesystem::path parse_path(std::string_view option, const std::string& text);

/// From `least` to `most`.
[[nodiscard]] std::uint64_t parse_whole_number(std::string_view option, std::string_view text,
                                               std::uint64_t least, std::uint64_t most);

/// FIRST:LAST, LAST excluded, at most `most`; either may be left out. At least one number is in it.
[[nodiscard]] std::pair<std::uint64_t, std::uint64_t> parse_range(std::string_view option,
                                                                  std::string_view text, std::uint64_t most);

/// Real numbers as an option takes them.
struct RealRange {
  double least, most;
  bool least_excluded = false;
};
[[nodiscard]] double parse_real(std::string_view option, std::string_view text, const RealRange& range);

}  // namespace kds
