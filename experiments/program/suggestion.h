#pragma once
// Suggests the name that a mistyped word was probably meant to be.

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace kds {

/// The nearest of the names by the edit distance (insertions, deletions, substitutions, exchanges of
/// neighbours; upper and lower case count as equal), or a name that the word begins or ends. None where no
/// name is near.
[[nodiscard]] std::optional<std::string_view> nearest_name(std::string_view word,
                                                           std::span<const std::string_view> names);

/// ", did you mean NAME?", or "" where no name is near.
[[nodiscard]] std::string suggestion(std::string_view word, std::span<const std::string_view> names);

}  // namespace kds
