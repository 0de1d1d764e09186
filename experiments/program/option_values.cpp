#include "experiments/program/option_values.h"

#include <algorithm>
#include <charconv>
#include <optional>

#include "experiments/program/suggestion.h"

namespace kds {

namespace {

template <class Number>
std::optional<Number> number_in(std::string_view text) {
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

}  // namespace

void refuse_unknown(std::string_view option, std::string_view word, std::span<const std::string_view> names,
                    std::string_view expected) {
  const std::string known =
      expected.empty() ? fmt::format("one of {}", fmt::join(names, ", ")) : std::string(expected);
  throw InputError(fmt::format("{}: '{}' is not {}{}", option, word, known, suggestion(word, names)));
}

std::size_t place_among(std::string_view option, std::string_view word,
                        std::span<const std::string_view> names) {
  const auto found = std::ranges::find(names, word);
  if (found == names.end()) refuse_unknown(option, word, names);
  return static_cast<std::size_t>(found - names.begin());
}

std::filesystem::path parse_path(std::string_view option, const std::string& text) {
  if (text == "-") throw InputError(fmt::format("{} needs a path; - is for --json only", option));
  return text;
}

std::uint64_t parse_whole_number(std::string_view option, std::string_view text, std::uint64_t least,
                                 std::uint64_t most) {
  const auto number = number_in<std::uint64_t>(text);
  if (number && *number >= least && *number <= most) return *number;
  throw InputError(fmt::format("{}: '{}' is not a whole number from {} to {}", option, text, least, most));
}

std::pair<std::uint64_t, std::uint64_t> parse_range(std::string_view option, std::string_view text,
                                                    std::uint64_t most) {
  const std::size_t colon = text.find(':');
  if (colon != std::string_view::npos) {
    const std::string_view from = text.substr(0, colon), to = text.substr(colon + 1);
    const auto first = from.empty() ? std::optional<std::uint64_t>(0) : number_in<std::uint64_t>(from);
    const auto last = to.empty() ? std::optional<std::uint64_t>(most) : number_in<std::uint64_t>(to);
    if (first && last && *first < *last && *last <= most) return {*first, *last};
  }
  throw InputError(fmt::format("{}: '{}' is not FIRST:LAST, whole numbers with FIRST below LAST, at most {}",
                               option, text, most));
}

double parse_real(std::string_view option, std::string_view text, const RealRange& range) {
  const auto number = number_in<double>(text);
  const bool enough = number && (range.least_excluded ? *number > range.least : *number >= range.least);
  if (enough && *number <= range.most) return *number == 0 ? 0 : *number;  // also turns -0 into 0
  throw InputError(fmt::format("{}: '{}' is not a number {} {}, at most {}", option, text,
                               range.least_excluded ? "above" : "from", range.least, range.most));
}

}  // namespace kds
