#pragma once
// Points for which the layered hierarchy is sqrt(h) times as large as the wrapped one (Lemma 2.5 of Agarwal
// et al.), which shows that the bound sqrt(h + 1) of Theorem 2.3 is almost tight.

#include <Eigen/Core>

namespace kds::models {

/// Returns 2^h points in sequence order, 1 <= h <= 24, on the unit circle in the plane z = 0. The sphere of
/// all points has radius 1. In the layered hierarchy, the sphere of any 2^l consecutive points that form a
/// node of the balanced tree has radius l / sqrt(h). Coordinates are rounded once, from `long double`.
[[nodiscard]] Eigen::Matrix3Xd tightness_points(int h);

}  // namespace kds::models
