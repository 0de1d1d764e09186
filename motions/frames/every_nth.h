#pragma once
// Reduces a trajectory to every n-th frame.

#include <cstddef>

#include "motions/frames/trajectory.h"

namespace kds {

/// Returns the frames 0, n, 2n ... with their numbers in the file. For n above 1 the times are dropped. A
/// trajectory at rest is returned unchanged.
[[nodiscard]] Trajectory every_nth(const Trajectory& trajectory, std::size_t n);

}  // namespace kds
