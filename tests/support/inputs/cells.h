#pragma once
// Periodic cells without the reader's doubt about them.

#include <optional>

#include "motions/frames/periodic.h"

namespace kds::test {

inline std::optional<Cell> cell_from_lengths(const Eigen::Vector3d& lengths, const Eigen::Vector3d& cosines) {
  return read_cell_from_lengths(lengths, cosines).cell;
}
inline std::optional<Cell> cell_from_angles(const Eigen::Vector3d& lengths, const Eigen::Vector3d& degrees) {
  return read_cell_from_angles(lengths, degrees).cell;
}

}  // namespace kds::test
