#include "motions/curves/motion_ref.h"

#include <fmt/format.h>

#include <stdexcept>

namespace kds::detail {

void refuse_changed_degree(int before, int now) {
  throw std::logic_error(fmt::format(
      "a motion of degree {} has become one of degree {}: structures and searches over it must be made anew",
      before, now));
}

}  // namespace kds::detail
