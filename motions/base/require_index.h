#pragma once
// Rejects an index that is too large, with a message that names the index and the number of elements.

#include <cstddef>
#include <string>
#include <string_view>

namespace kds {

/// Returns a message such as "there is no bead 12: there are 10, numbered 0 to 9". `what` is the singular
/// noun.
[[nodiscard]] std::string no_such_index(std::string_view what, std::size_t index, std::size_t count);

namespace detail {

[[noreturn]] void refuse_index(std::string_view what, std::size_t index, std::size_t count);

}  // namespace detail

/// Throws std::invalid_argument with this message unless `index` is below `count`.
inline void require_index(std::string_view what, std::size_t index, std::size_t count) {
  if (index >= count) [[unlikely]]
    detail::refuse_index(what, index, count);
}

}  // namespace kds
