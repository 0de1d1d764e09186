#include "structures/enclosing_sphere/enclosing_sphere.h"

#include <algorithm>

#include "structures/enclosing_sphere/pivot_sphere.h"
#include "structures/enclosing_sphere/sphere_scan.h"

namespace kds {

namespace {

// Returns whether bead `b` sticks out of the sphere.
template <class Form>
bool sticks_out(const Balls<Form::Dimension>& balls, const typename Form::Sphere& sphere, BeadId b) {
  detail::Farthest one;
  one.scan(Form::measure(balls, sphere), b, b);
  return one.result() > sphere.outer;
}

template <class Form>
[[KDS_SCAN_TARGETS]] std::size_t count_outside(const Balls<Form::Dimension>& balls,
                                               const typename Form::Sphere& sphere, BeadId first,
                                               BeadId last) {
  return detail::count_outside<Form>(
      balls,
      sphere, [&](const auto&, const auto& look) __attribute__((always_inline)) { look(first, last); });
}
template <class Form>
[[KDS_SCAN_TARGETS]] BeadId escaped_bead(const Balls<Form::Dimension>& balls,
                                         const typename Form::Sphere& sphere, BeadId first, BeadId last) {
  return detail::escaped_bead<Form>(
      balls,
      sphere, [&](const auto&, const auto& look) __attribute__((always_inline)) { look(first, last); });
}

// Returns whether the basis was proved.
template <class Form>
bool pivot_to_proof(const Balls<Form::Dimension>& balls, BeadId first, BeadId last,
                    std::span<const BeadId> guess, Basis& basis, Cage<Form::Dimension>& cage) {
  using Sphere = typename Form::Sphere;
  basis = Basis(guess.empty() ? std::span<const BeadId>(&first, 1) : guess.first(1));
  for (const BeadId b : guess.empty() ? guess : guess.subspan(1)) {
    if (basis.contains(b)) continue;
    const Sphere sphere = detail::sphere_of_basis<Form>(balls, basis);
    if (sticks_out<Form>(balls, sphere, b) && !Form::pivot(balls, basis, b)) return false;
  }
  for (int pivots = 0; pivots < detail::most_pivots; ++pivots) {
    const Sphere sphere = detail::sphere_of_basis<Form>(balls, basis);
    if (detail::is_proved<Form>(basis, sphere, count_outside<Form>(balls, sphere, first, last))) {
      cage = {sphere.center, sphere.radius};
      return true;
    }
    if (!detail::next_basis<Form>(balls, basis, sphere,
                                  [&] { return escaped_bead<Form>(balls, sphere, first, last); }))
      return false;
  }
  return false;
}

}  // namespace

template <int Dimension>
SmallestSphere smallest_sphere(const Balls<Dimension>& balls, BeadId first, BeadId last,
                               std::span<const BeadId> guess, ExactUse use) {
  SmallestSphere result;
  Cage<Dimension> cage;
  const bool of_points = balls.equal_radii();
  bool proved = false;
  if (use == ExactUse::everywhere) {
    result.basis = Basis(std::span<const BeadId>(&first, 1));
  } else if (of_points) {
    proved = pivot_to_proof<PointForm<Dimension>>(balls, first, last, guess, result.basis, cage);
  } else {
    proved = pivot_to_proof<BallForm<Dimension>>(balls, first, last, guess, result.basis, cage);
  }
  if (!proved) {
    result.took_exact = true;
    cage = enclosing_sphere_exactly(balls, first, last, result.basis, of_points, use);
  }
  result.sphere = sphere_of(cage, of_points ? balls.radius(first) : 0);
  return result;
}

template <int Dimension>
bool is_certainly_proper(std::span<const std::array<double, Dimension>> centers,
                         std::span<const double> radii) {
  bool proper = false;
  visit_size<Dimension>(centers.size(), [&](auto m) {
    detail::BasisBalls<double, Dimension, m> balls;
    for (std::size_t i = 0; i <= m; ++i) {
      std::copy_n(centers[i].begin(), Dimension, balls.center[i].begin());
      balls.radius[i] = radii[i];
    }
    proper = BallForm<Dimension>::sphere(balls).certain;
  });
  return proper;
}

template bool is_certainly_proper<2>(std::span<const std::array<double, 2>>, std::span<const double>);
template bool is_certainly_proper<3>(std::span<const std::array<double, 3>>, std::span<const double>);
template SmallestSphere smallest_sphere(const Balls<2>&, BeadId, BeadId, std::span<const BeadId>, ExactUse);
template SmallestSphere smallest_sphere(const Balls<3>&, BeadId, BeadId, std::span<const BeadId>, ExactUse);

}  // namespace kds
