#pragma once
// CGAL's smallest enclosing sphere over rational numbers. Exact numbers allow CGAL's LP algorithm; the
// default algorithm for double, farthest first, is wrong on cospherical points.

#include <span>

#include "tests/support/judges/exact_checks.h"

namespace kds::test {

[[nodiscard]] ExactSphere cgal_smallest_sphere(std::span<const ExactPoint> points, BeadId first, BeadId last);

}  // namespace kds::test
