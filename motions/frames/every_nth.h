#pragma once
// A trajectory with fewer frames.

#include <cstddef>

#include "motions/frames/trajectory.h"

namespace kds {

/// Its frames 0, n, 2n ..., with their numbers in the file and, for n above 1, without their times; one at
/// rest stays as it is.
[[nodiscard]] Trajectory every_nth(const Trajectory& trajectory, std::size_t n);

}  // namespace kds
