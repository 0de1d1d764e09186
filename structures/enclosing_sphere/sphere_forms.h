#pragma once
// Two forms of balls for the search for a minimum enclosing sphere: points, for equal radii, or balls.

#include "structures/enclosing_sphere/sphere_of_balls.h"
#include "structures/enclosing_sphere/sphere_scan.h"

namespace kds {

/// Spheres through centres. The caller adds the common radius for output.
template <int Dim>
struct PointForm {
  static constexpr int Dimension = Dim;
  using Sphere = BasisSphere<double, Dimension>;
  static constexpr bool of_points = true;

  template <bool bounds = true, class N, std::size_t M>
  [[gnu::always_inline]] static BasisSphere<N, Dimension> sphere(
      const detail::BasisBalls<N, Dimension, M>& balls) {
    return detail::sphere_of_points<bounds>(balls);
  }
  [[gnu::always_inline]] static bool pivot(const Balls<Dimension>& balls, Basis& basis, BeadId escaped) {
    return pivot_points(balls, basis, escaped);
  }
  [[gnu::always_inline]] static auto measure(const Balls<Dimension>& balls, const Sphere& sphere) {
    return detail::PointMeasure<Dimension>{detail::coordinates_of(balls), sphere.center, sphere.inner};
  }
  /// Returns the radius within which centres are inside.
  [[gnu::always_inline]] static double inner_radius(const Sphere& sphere) {
    return sphere.inner > 0 ? std::sqrt(sphere.inner) * (1 - 4 * detail::unit_roundoff) : 0;
  }
  [[gnu::always_inline]] static double reach(const Balls<Dimension>& balls, BeadId bead,
                                             const Point<Dimension>& from) {
    const Point<Dimension> d = detail::minus(detail::center_of(balls, bead), from);
    return detail::dot(d, d);
  }
};

template <int Dim>
struct BallForm {
  static constexpr int Dimension = Dim;
  using Sphere = BasisSphere<double, Dimension>;
  static constexpr bool of_points = false;

  template <bool bounds = true, class N, std::size_t M>
  [[gnu::always_inline]] static BasisSphere<N, Dimension> sphere(
      const detail::BasisBalls<N, Dimension, M>& balls) {
    return detail::sphere_of_balls<bounds>(balls);
  }
  [[nodiscard]] static bool pivot(const Balls<Dimension>& balls, Basis& basis, BeadId escaped) {
    return pivot_balls(balls, basis, escaped);
  }
  [[gnu::always_inline]] static auto measure(const Balls<Dimension>& balls, const Sphere& sphere) {
    return detail::BallMeasure<Dimension>{detail::coordinates_of(balls), balls.radii(), sphere.center,
                                          sphere.inner};
  }
  [[gnu::always_inline]] static double inner_radius(const Sphere& sphere) { return sphere.inner; }
  [[gnu::always_inline]] static double reach(const Balls<Dimension>& balls, BeadId bead,
                                             const Point<Dimension>& from) {
    const Point<Dimension> d = detail::minus(detail::center_of(balls, bead), from);
    return std::sqrt(detail::dot(d, d)) + balls.radii()[bead];
  }
};

}  // namespace kds
