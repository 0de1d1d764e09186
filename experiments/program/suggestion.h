#pragma once
// Suggests the name that a mistyped word probably stands for.

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace kds {

/// Returns the nearest of the names by edit distance, without regard to case. The distance counts insertions,
/// deletions, substitutions and exchanges of neighbours. If no name is near, returns a name that begins or
/// ends with the word, or nothing.
[[nodiscard]] std::optional<std::string_view> nearest_name(std::string_view word,
                                                           std::span<const std::string_view> names);

/// Returns ", did you mean NAME?", or "" if no name is near.
[[nodiscard]] std::string suggestion(std::string_view word, std::span<const std::string_view> names);

}  // namespace kds
