#pragma once
// Places beads at equal distances along a curve, for the paper's splines, grills and spirals.

#include <cstddef>
#include <functional>

#include "motions/models/shape.h"

namespace kds::models {

using Curve = std::function<Eigen::Vector3d(double)>;  ///< maps t in [0, 1] to a point

/// Returns `beads` (at least 2) beads at equal arc lengths along the curve, ends included. The curve is
/// scaled so that consecutive beads are `bond` diameters apart along it, so their distance in space is at
/// most that. The curve is approximated by a polyline of `pieces` equal parts of [0, 1]; its corners should
/// be among the ends of the parts.
[[nodiscard]] Shape beads_along(const Curve& curve, std::size_t beads, double bond, std::size_t pieces);

}  // namespace kds::models
