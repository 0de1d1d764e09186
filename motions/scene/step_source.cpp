#include "motions/scene/step_source.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "motions/base/input_error.h"

namespace kds {

InstanceStep::InstanceStep(Instance instance) : instance_(std::move(instance)) {
  for (std::size_t point = 0; point < instance_.point_count(); ++point) {
    for (int column = 0; column < instance_.columns; ++column) {
      for (int k = 0; k <= instance_.degree; ++k) {
        if (std::isfinite(instance_.control_point(point, column, k))) continue;
        throw InputError(fmt::format("{}: bead {}, column {}: expected finite control points, found {}",
                                     instance_.file, point, column,
                                     instance_.control_point(point, column, k)));
      }
    }
  }
}

Eigen::Matrix3Xd InstanceStep::points(std::size_t frame) const {
  const auto count = static_cast<Eigen::Index>(instance_.point_count());
  Eigen::Matrix3Xd centers = Eigen::Matrix3Xd::Zero(3, count);
  for (Eigen::Index point = 0; point < count; ++point)
    for (int axis = 0; axis < dimension(); ++axis)
      centers(axis, point) = coordinate(static_cast<BeadId>(point), frame == 0 ? 0 : degree(), axis);
  return centers;
}

}  // namespace kds
