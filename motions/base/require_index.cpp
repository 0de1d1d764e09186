#include "motions/base/require_index.h"

#include <fmt/format.h>

#include <stdexcept>

namespace kds {

std::string no_such_index(std::string_view what, std::size_t index, std::size_t count) {
  if (count == 0) return fmt::format("there is no {0} {1}: there is no {0} at all", what, index);
  if (count == 1) return fmt::format("there is no {} {}: there is 1, numbered 0", what, index);
  return fmt::format("there is no {} {}: there are {}, numbered 0 to {}", what, index, count, count - 1);
}

void detail::refuse_index(std::string_view what, std::size_t index, std::size_t count) {
  throw std::invalid_argument(no_such_index(what, index, count));
}

}  // namespace kds
