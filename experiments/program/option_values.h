#pragma once
// Parses the values of options. Each function throws an InputError that names the option, the text found and
// the expected form, and suggests the name that a mistyped word probably stands for.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "motions/base/input_error.h"

namespace kds {

/// Returns the nearest of the names by edit distance, without regard to case. The distance counts insertions,
/// deletions, substitutions and exchanges of neighbours. If no name is near, returns a name that begins or
/// ends with the word, or nothing.
[[nodiscard]] std::optional<std::string_view> nearest_name(std::string_view word,
                                                           std::span<const std::string_view> names);

/// Returns ", did you mean NAME?", or "" if no name is near.
[[nodiscard]] std::string suggestion(std::string_view word, std::span<const std::string_view> names);

/// Throws an InputError which says that the word is not one of `names`, and suggests the nearest name. By
/// default the message lists the names; `expected`, if given, replaces that list as the end of the sentence
/// "'WORD' is not ...".
[[noreturn]] void refuse_unknown(std::string_view option, std::string_view word,
                                 std::span<const std::string_view> names, std::string_view expected = "");

/// Throws InputError if an option that applies only to `uses` is given with other `words`. `where` says where
/// the words stand.
void require_use_of(std::string_view option, const std::vector<std::string_view>& uses,
                    const std::vector<std::string>& words, std::string_view where);

/// Returns the index of `word` in `names`. Throws InputError if `word` is not a name.
[[nodiscard]] std::size_t index_among(std::string_view option, std::string_view word,
                                      std::span<const std::string_view> names);

/// Returns the enumerator with this name. `names` are the names of the enumerators from `first` on.
template <class Enum>
[[nodiscard]] Enum choice_of(std::string_view option, std::string_view word,
                             std::span<const std::string_view> names, Enum first = Enum{}) {
  return static_cast<Enum>(static_cast<std::size_t>(first) + index_among(option, word, names));
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

/// Returns the numbers of a comma-separated list, ascending. Throws InputError also if one is listed twice.
[[nodiscard]] std::vector<double> parse_reals(std::string_view option, const std::string& list,
                                              const RealRange& range);

/// Returns the names of structures in the order of the registry, whatever the order in `list`. A set of
/// structures therefore always gives the same run. Throws InputError.
[[nodiscard]] std::vector<std::string> parse_structures(const std::string& list);

/// Returns the strides in ascending order. Throws InputError.
[[nodiscard]] std::vector<std::size_t> parse_strides(const std::string& list);

}  // namespace kds
