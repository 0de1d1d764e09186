#pragma once
// The edit distance of two words, by which mistyped names are found.

#include <cstddef>
#include <string_view>

namespace kds {

/// Returns how many insertions, deletions, substitutions and exchanges of neighbours make `b` of `a`: the
/// Damerau-Levenshtein distance in which no letter is edited twice (optimal string alignment).
[[nodiscard]] std::size_t edit_distance(std::string_view a, std::string_view b);

}  // namespace kds
