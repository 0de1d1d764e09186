#pragma once
// Parses the values of options. Each function throws an InputError that names the option, the text found and
// the expected form.

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

/// Throws an InputError which says that the word is not one of `names`, and suggests the nearest name. By
/// default the message lists the names; `expected`, if given, replaces that list as the end of the sentence
/// "'WORD' is not ...".
[[noreturn]] void refuse_unknown(std::string_view option, std::string_view word,
                                 std::span<const std::string_view> names, std::string_view expected = "");

/// Returns the index of `word` in `names`. Throws InputError if `word` is not a name.
[[nodiscard]] std::size_t place_among(std::string_view option, std::string_view word,
                                      std::span<const std::string_view> names);

/// Returns the enumerator with this name. `names` are the names of the enumerators from `first` on.
template <class Enum>
[[nodiscard]] Enum choice_of(std::string_view option, std::string_view word,
                             std::span<const std::string_view> names, Enum first = Enum{}) {
  return static_cast<Enum>(static_cast<std::size_t>(first) + place_among(option, word, names));
}

/// Returns the path of a file or directory. The path - is refused.
[[nodiscard]] std::filesystem::path parse_path(std::string_view option, const std::string& text);

/// Returns a whole number in [`least`, `most`].
[[nodiscard]] std::uint64_t parse_whole_number(std::string_view option, std::string_view text,
                                               std::uint64_t least, std::uint64_t most);

/// Parses FIRST:LAST with LAST excluded. FIRST and LAST are at most `most`, and either may be omitted. The
/// range holds at least one number.
[[nodiscard]] std::pair<std::uint64_t, std::uint64_t> parse_range(std::string_view option,
                                                                  std::string_view text, std::uint64_t most);

/// The range of real numbers that an option accepts.
struct RealRange {
  double least, most;
  bool least_excluded = false;
};
[[nodiscard]] double parse_real(std::string_view option, std::string_view text, const RealRange& range);

}  // namespace kds
