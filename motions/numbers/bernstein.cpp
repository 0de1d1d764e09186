#include "motions/numbers/bernstein.h"

#include <fmt/format.h>

#include <stdexcept>

namespace kds::detail {

void refuse_unlike_degrees(std::size_t a, std::size_t b) {
  throw std::logic_error(
      fmt::format("polynomials of {} and {} coefficients are added: write them with one degree first", a, b));
}

}  // namespace kds::detail
