#pragma once
// What the values of options are made of, for the parsers of all commands: each throws InputError that names
// the option, what was found and what is expected.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "experiments/program/command_line.h"
#include "motions/base/input_error.h"

namespace kds {

template <class Value>
using Choice = std::pair<std::string_view, Value>;

/// One of several names; none where the option is not given.
template <class Value, std::size_t count>
[[nodiscard]] std::optional<Value> chosen(const ParsedArguments& parsed, std::string_view option,
                                          const std::array<Choice<Value>, count>& choices) {
  const std::optional<std::string> word = parsed.value(option);
  if (!word) return std::nullopt;
  std::vector<std::string_view> names;
  for (const auto& [name, value] : choices) {
    if (name == *word) return value;
    names.push_back(name);
  }
  throw InputError(fmt::format("{}: '{}' is not one of {}", option, *word, fmt::join(names, ", ")));
}

/// The path of a file or directory; none where the option is not given, - is refused.
[[nodiscard]] std::optional<std::filesystem::path> path_of(const ParsedArguments& parsed,
                                                           std::string_view option);

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
