#pragma once
// Beads at equal distances along a curve, as in the paper's splines, grills and spirals.

#include <cstddef>
#include <functional>

#include "motions/models/shape.h"

namespace kds::models {

using Curve = std::function<Eigen::Vector3d(double)>;  ///< of t in [0, 1]

/// `beads` (at least 2) at equal lengths along the curve, ends included, after scaling it so that consecutive
/// beads are `bond` diameters apart along it, and hence in space at most. The curve is taken as a polyline of
/// `pieces` equal parts of [0, 1]; its corners should be among them.
[[nodiscard]] Shape beads_along(const Curve& curve, std::size_t beads, double bond, std::size_t pieces);

}  // namespace kds::models
