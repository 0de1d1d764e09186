#include "structures/enclosing_sphere/enclosing_sphere.h"

#include "structures/enclosing_sphere/pivot_sphere.h"
#include "structures/enclosing_sphere/scan_targets.h"

namespace kds {

namespace {

// Whether the basis was proved.
template <class Form>
[[KDS_SCAN_TARGETS]] bool settle(const Balls<Form::Dimension>& balls, BeadId first, BeadId last,
                                 std::span<const BeadId> guess, Basis& basis, Cage<Form::Dimension>& cage) {
  using Sphere = typename Form::Sphere;
  const auto visit = [&](const Sphere&, const auto& look) __attribute__((always_inline)) {
    look(first, last);
  };
  basis = Basis(guess.empty() ? std::span<const BeadId>(&first, 1) : guess.first(1));
  for (const BeadId b : guess.empty() ? guess : guess.subspan(1)) {
    if (basis.contains(b)) continue;
    const Sphere sphere = detail::sphere_of_basis<Form>(balls, basis);
    detail::Farthest one;
    one.scan(Form::measure(balls, sphere), b, b);
    if (one.result() > sphere.outer && !Form::pivot(balls, basis, b)) return false;
  }
  for (int pivots = 0; pivots < detail::most_pivots; ++pivots) {
    const Sphere sphere = detail::sphere_of_basis<Form>(balls, basis);
    const std::size_t outside = detail::count_outside<Form>(balls, sphere, visit);
    if (detail::is_proved<Form>(basis, sphere, outside)) {
      cage = {sphere.center, sphere.radius};
      return true;
    }
    if (!detail::next_basis<Form>(balls, basis, sphere, visit)) return false;
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
    proved = settle<PointForm<Dimension>>(balls, first, last, guess, result.basis, cage);
  } else {
    proved = settle<BallForm<Dimension>>(balls, first, last, guess, result.basis, cage);
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
