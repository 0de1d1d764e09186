#include "experiments/program/option_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <optional>
#include <string_view>

#include "experiments/output/text.h"
#include "motions/base/input_error.h"
#include "motions/base/text_input.h"
#include "structures/session/structure_spec.h"

namespace kds {

std::optional<std::string_view> nearest_name(std::string_view word, std::span<const std::string_view> names) {
  constexpr std::size_t longest = 64, letters_for_a_part = 3;
  if (word.empty() || word.size() > longest) return std::nullopt;
  const std::string typed = lower_case(word);
  const std::size_t dashes = std::min(typed.find_first_not_of('-'), typed.size());
  const std::string_view bare = std::string_view(typed).substr(dashes);
  std::optional<std::string_view> nearest;
  std::size_t least = 0;
  for (const std::string_view name : names) {
    const std::string known = lower_case(name);
    const std::size_t distance = edit_distance(typed, known);
    const std::size_t letters =
        std::max(bare.size(), known.size() - std::min(known.find_first_not_of('-'), known.size()));
    const bool begins = bare.size() >= letters_for_a_part && known.starts_with(typed);
    const bool is_part = begins || (bare.size() >= letters_for_a_part && known.ends_with(bare));
    const bool is_near = distance <= std::max<std::size_t>(1, letters / 3) && distance < known.size();
    if (!is_part && !is_near) continue;
    const std::size_t rank = begins ? 0 : is_near ? distance : longest + distance;
    if (nearest && rank >= least) continue;
    nearest = name;
    least = rank;
  }
  return nearest;
}

std::string suggestion(std::string_view word, std::span<const std::string_view> names) {
  const auto name = nearest_name(word, names);
  return name ? fmt::format(", did you mean {}?", *name) : "";
}

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
  throw InputError(option, fmt::format("'{}' is not {}{}", word, known, suggestion(word, names)));
}

void require_use_of(std::string_view option, const std::vector<std::string_view>& uses,
                    const std::vector<std::string>& words, std::string_view where) {
  if (std::find_first_of(uses.begin(), uses.end(), words.begin(), words.end()) != uses.end()) return;
  if (uses.size() == 1)
    throw InputError(option, fmt::format("applies only to {}, which is not {}", uses.front(), where));
  throw InputError(option, fmt::format("applies only to {} and {}, none of which is {}",
                                       fmt::join(uses.begin(), uses.end() - 1, ", "), uses.back(), where));
}

std::size_t index_among(std::string_view option, std::string_view word,
                        std::span<const std::string_view> names) {
  const auto found = std::ranges::find(names, word);
  if (found == names.end()) refuse_unknown(option, word, names);
  return static_cast<std::size_t>(found - names.begin());
}

std::filesystem::path parse_path(std::string_view option, const std::string& text) {
  if (text == "-")
    throw InputError(fmt::format("{} needs a path; - is for {} only, and standard input is not read",
                                 argument(option), "--json"_arg));
  return text;
}

std::uint64_t parse_whole_number(std::string_view option, std::string_view text, std::uint64_t least,
                                 std::uint64_t most) {
  const auto number = number_in<std::uint64_t>(text);
  if (number && *number >= least && *number <= most) return *number;
  throw InputError(option, fmt::format("'{}' is not a whole number from {} to {}", text, least, most));
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
  throw InputError(
      option,
      fmt::format("'{}' is not FIRST:LAST, whole numbers with FIRST below LAST, at most {}", text, most));
}

double parse_real(std::string_view option, std::string_view text, const RealRange& range) {
  const auto number = number_in<double>(text);
  const bool enough = number && (range.least_excluded ? *number > range.least : *number >= range.least);
  if (enough && *number <= range.most) return *number == 0 ? 0 : *number;  // also turns -0 into 0
  throw InputError(option, fmt::format("'{}' is not a number {} {}, at most {}", text,
                                       range.least_excluded ? "above" : "from", range.least, range.most));
}

std::vector<double> parse_reals(std::string_view option, const std::string& list, const RealRange& range) {
  std::vector<double> values;
  for (const std::string& text : split(list, ',')) values.push_back(parse_real(option, text, range));
  std::sort(values.begin(), values.end());
  if (const auto twice = std::adjacent_find(values.begin(), values.end()); twice != values.end())
    throw InputError(option, fmt::format("{} is listed twice", *twice));
  return values;
}

std::vector<std::string> parse_structures(const std::string& list) {
  const std::vector<std::string> names = split(list, ',');
  std::vector<std::string_view> known;
  std::vector<std::string> ordered;
  for (const StructureSpec& spec : structure_registry().all()) {
    known.push_back(spec.name);
    if (std::find(names.begin(), names.end(), spec.name) != names.end()) ordered.push_back(spec.name);
  }
  for (const std::string& name : names) {
    if (std::find(known.begin(), known.end(), name) == known.end())
      refuse_unknown("--structures", name, known);
    if (std::count(names.begin(), names.end(), name) > 1)
      throw InputError("--structures", fmt::format("{} is listed twice", name));
  }
  return ordered;
}

std::vector<std::size_t> parse_strides(const std::string& list) {
  std::vector<std::size_t> strides;
  for (const std::string& text : split(list, ','))
    strides.push_back(parse_whole_number("--strides", text, 1, 1'000'000'000));
  std::sort(strides.begin(), strides.end());
  if (const auto twice = std::adjacent_find(strides.begin(), strides.end()); twice != strides.end())
    throw InputError("--strides", fmt::format("{} is listed twice", *twice));
  return strides;
}

}  // namespace kds
