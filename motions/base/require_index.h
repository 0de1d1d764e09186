#pragma once
// Rejects an index that is too large, with a message that names the index and the number of elements.

#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>

namespace kds {

/// Returns a message such as "there is no bead 12: there are 10, numbered 0 to 9". `what` is the singular
/// noun.
[[nodiscard, gnu::cold]] inline std::string no_such_index(std::string_view what, std::size_t index,
                                                          std::size_t count) {
  const std::string noun(what), start = "there is no " + noun + ' ' + std::to_string(index) + ": there ";
  if (count == 0) return start + "is no " + noun + " at all";
  if (count == 1) return start + "is 1, numbered 0";
  return start + "are " + std::to_string(count) + ", numbered 0 to " + std::to_string(count - 1);
}

/// Throws std::invalid_argument with this message unless `index` is below `count`.
inline void require_index(std::string_view what, std::size_t index, std::size_t count) {
  if (index >= count) [[unlikely]]
    throw std::invalid_argument(no_such_index(what, index, count));
}

}  // namespace kds
