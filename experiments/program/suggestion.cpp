#include "experiments/program/suggestion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

#include "motions/base/edit_distance.h"

namespace kds {

namespace {

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

std::string lower(std::string_view text) {
  std::string result(text);
  std::ranges::transform(result, result.begin(), [](char c) { return lower(c); });
  return result;
}

}  // namespace

std::optional<std::string_view> nearest_name(std::string_view word, std::span<const std::string_view> names) {
  constexpr std::size_t longest = 64, letters_for_a_part = 3;
  if (word.empty() || word.size() > longest) return std::nullopt;
  const std::string typed = lower(word);
  const std::size_t dashes = std::min(typed.find_first_not_of('-'), typed.size());
  const std::string_view bare = std::string_view(typed).substr(dashes);
  std::optional<std::string_view> nearest;
  std::size_t least = 0;
  for (const std::string_view name : names) {
    const std::string known = lower(name);
    const std::size_t distance = edit_distance(typed, known);
    const std::size_t letters =
        std::max(bare.size(), known.size() - std::min(known.find_first_not_of('-'), known.size()));
    const bool is_part = bare.size() >= letters_for_a_part &&
                         (known.ends_with(bare) || (bare.size() < known.size() && known.starts_with(typed)));
    const bool is_near = distance <= std::max<std::size_t>(1, letters / 3) && distance < known.size();
    if (!is_part && !is_near) continue;
    const std::size_t rank = is_near ? distance : longest + distance;
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

}  // namespace kds
