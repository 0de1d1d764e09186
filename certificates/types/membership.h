#pragma once
// Selects the certificate that a ball lies in the sphere of a basis, or in the relaxed sphere. If the radii
// involved are equal during the whole step, the selected certificate is the one for equal radii, also for
// beads of an unequal necklace. Otherwise the radical certificate is selected. The plane and space are
// supported. The two types are exact; the types in their identities distinguish them.
//
//   equal radii    bases of 1, 2 and (in space) 3 beads: bead_in_sphere.h; full bases: a power test times the
//                  basis' orientation, where the weights are equal too
//   others         ball_in_sphere.h

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <optional>
#include <span>

#include "certificates/base/radical.h"
#include "certificates/types/ball_in_sphere.h"
#include "certificates/types/bead_in_sphere.h"
#include "certificates/types/power_test.h"

namespace kds {

namespace detail {

/// Returns whether `value(bead, k)` is the same for all of these beads, for every control point k.
template <std::invocable<BeadId, int> Value>
[[nodiscard]] bool all_equal(std::span<const BeadId> beads, int degree, Value value) {
  return std::all_of(beads.begin(), beads.end(), [&](BeadId bead) {
    for (int k = 0; k <= degree; ++k) {
      if (value(bead, k) != value(beads.front(), k)) return false;
    }
    return true;
  });
}

template <std::size_t N>
[[nodiscard]] std::array<BeadId, N + 1> with_bead(std::span<const BeadId> basis, BeadId bead) {
  std::array<BeadId, N + 1> beads{};
  std::copy_n(basis.begin(), N, beads.begin());
  beads[N] = bead;
  return beads;
}

/// Returns whether the certificate for equal radii applies to these beads.
template <Motion M>
[[nodiscard]] bool of_equal_radii(Radii radii, const M& motion, std::span<const BeadId> beads, bool is_full) {
  return radii == Radii::equal ||
         (all_equal(beads, degree_of(motion), [&](BeadId b, int k) { return motion.radius(b, k); }) &&
          (!is_full ||
           all_equal(beads, degree_of(motion), [&](BeadId b, int k) { return motion.weight(b, k); })));
}

}  // namespace detail

/// Calls `visit` with the certificate that `bead` lies inside (or, if not `inside`, outside) the sphere of
/// `basis`. The basis has 1 to dimension + 1 beads, ascending. `orientation` is the orientation of a full
/// basis (orientation.h).
template <Motion M, class Visit>
decltype(auto) visit_membership(Radii radii, const M& motion, std::span<const BeadId> basis, BeadId bead,
                                bool inside, int orientation, Visit&& visit) {
  constexpr std::size_t full = M::dimension + 1;
  const bool is_full = basis.size() == full;
  std::array<BeadId, full + 1> all{};
  std::copy(basis.begin(), basis.end(), all.begin());
  all[basis.size()] = bead;
  if (!detail::of_equal_radii(radii, motion, std::span(all).first(basis.size() + 1), is_full)) {
    if (is_full) return visit(BallInSphere<M::dimension, full>{all, inside, orientation});
    if (basis.size() == 1)
      return visit(BallInSphere<M::dimension, 1>{detail::with_bead<1>(basis, bead), inside});
    if constexpr (full == 4) {
      if (basis.size() == 3) return visit(BallInSphere<3, 3>{detail::with_bead<3>(basis, bead), inside});
    }
    return visit(BallInSphere<M::dimension, 2>{detail::with_bead<2>(basis, bead), inside});
  }
  if (is_full) return visit(PowerTest<M::dimension>(all, inside ? -orientation : orientation));
  if (basis.size() == 1) return visit(BeadInSphere<1>{detail::with_bead<1>(basis, bead), inside});
  if constexpr (full == 4) {
    if (basis.size() == 3) return visit(BeadInSphere<3>{detail::with_bead<3>(basis, bead), inside});
  }
  return visit(BeadInSphere<2>{detail::with_bead<2>(basis, bead), inside});
}

// Selects the certificate that a ball lies in the relaxed sphere of a basis, by the same comparison of
// radii. A ball whose radius differs from some of the basis' is relaxed if the requirements
// on the basis certainly hold on the whole step (ball_in_sphere.h). Otherwise its certificate is that of the
// sphere itself. The choice uses only control points in double, so it is the same for every kernel.
//
//   equal radii    bases of two or more: RelaxedBeadInSphere of bead_in_sphere.h
//   others         ball_in_sphere.h, relaxed; in a basis of two or more, its two balls farthest apart come
//   first

namespace detail {

/// Returns the difference of two centres' control points.
template <Motion M>
[[nodiscard]] std::array<double, M::dimension> control_difference(const M& motion, BeadId a, BeadId b,
                                                                  int k) {
  std::array<double, M::dimension> d;
  for (int axis = 0; axis < M::dimension; ++axis)
    d[static_cast<std::size_t>(axis)] = motion.coordinate(a, k, axis) - motion.coordinate(b, k, axis);
  return d;
}

template <std::size_t N>
[[nodiscard]] double product(const std::array<double, N>& a, const std::array<double, N>& b) {
  double sum = 0;
  for (std::size_t axis = 0; axis < N; ++axis) sum += a[axis] * b[axis];
  return sum;
}

/// Returns a lower bound of the distance of two centres during the step: their difference along the sum of
/// the differences at both ends, minus a bound on rounding. Returns minus infinity if doubles cannot decide.
template <Motion M>
[[nodiscard]] double least_distance(const M& motion, BeadId a, BeadId b) {
  const int degree = degree_of(motion);
  auto along = control_difference(motion, a, b, 0);
  const auto last = control_difference(motion, a, b, degree);
  for (std::size_t axis = 0; axis < along.size(); ++axis) along[axis] += last[axis];
  const double length = std::sqrt(product(along, along));
  double least = HUGE_VAL;
  for (int k = 0; k <= degree; ++k) {
    const auto d = control_difference(motion, a, b, k);
    const double distance = product(d, along) / length - 0x1p-40 * std::sqrt(product(d, d));
    if (!std::isfinite(distance)) return -HUGE_VAL;  // reversed, or squares over- or underflow
    least = std::min(least, distance);
  }
  return least;
}

/// Moves the two balls of the basis that are farthest apart at both ends of the step to the front.
template <Motion M>
void put_farthest_first(const M& motion, std::span<BeadId> basis) {
  std::size_t first = 0, second = 1;
  double farthest = -1;
  for (std::size_t i = 0; i < basis.size(); ++i) {
    for (std::size_t j = i + 1; j < basis.size(); ++j) {
      double square = 0;
      for (const int k : {0, degree_of(motion)}) {
        const auto d = control_difference(motion, basis[i], basis[j], k);
        square += product(d, d);
      }
      if (square > farthest) {
        farthest = square;
        first = i;
        second = j;
      }
    }
  }
  // `first` is before `second`, so move one after the other to the front.
  std::rotate(basis.begin(), basis.begin() + static_cast<std::ptrdiff_t>(first),
              basis.begin() + static_cast<std::ptrdiff_t>(first) + 1);
  std::rotate(basis.begin() + 1, basis.begin() + static_cast<std::ptrdiff_t>(second),
              basis.begin() + static_cast<std::ptrdiff_t>(second) + 1);
}

/// Returns whether the requirements of ball_in_sphere.h on the first two balls of a relaxed basis and on the
/// ball certainly hold.
template <Motion M>
[[nodiscard]] bool may_be_relaxed(const M& motion, std::span<const BeadId> basis, BeadId ball) {
  double largest = 0;
  for (int k = 0; k <= degree_of(motion); ++k) {
    const double radius = motion.radius(ball, k);
    if (!((motion.radius(basis[0], k) + motion.radius(basis[1], k)) * (1 - 0x1p-50) >= radius)) return false;
    largest = std::max(largest, radius);
  }
  return least_distance(motion, basis[0], basis[1]) >= largest;
}

/// Returns 1 if sorting takes an even number of exchanges, else -1.
[[nodiscard]] inline int sign_of_order(std::span<const BeadId> beads) {
  int sign = 1;
  for (std::size_t i = 0; i < beads.size(); ++i)
    for (std::size_t j = i + 1; j < beads.size(); ++j)
      if (beads[j] < beads[i]) sign = -sign;
  return sign;
}

}  // namespace detail

/// Calls `visit` with the certificate that `bead` lies inside the sphere of `basis`, relaxed. The other
/// arguments are those of visit_membership.
template <Motion M, class Visit>
decltype(auto) visit_relaxed_membership(Radii radii, const M& motion, std::span<const BeadId> basis,
                                        BeadId bead, int orientation, const Relaxation& relaxation,
                                        Visit&& visit) {
  constexpr int dimension = M::dimension;
  constexpr std::size_t full = dimension + 1;
  const std::size_t size = basis.size();
  std::array<BeadId, full + 1> all{};
  std::copy(basis.begin(), basis.end(), all.begin());
  all[size] = bead;
  const auto visit_exact = [&]() -> decltype(auto) {
    return visit_membership(radii, motion, basis, bead, true, orientation, visit);
  };
  if (detail::of_equal_radii(radii, motion, std::span(all).first(size + 1), false)) {
    if (size == 1) return visit_exact();
    if constexpr (full == 4) {
      if (size == 4) return visit(RelaxedBeadInSphere<4>{all, relaxation});
    }
    if (size == 3) return visit(RelaxedBeadInSphere<3>{detail::with_bead<3>(basis, bead), relaxation});
    return visit(RelaxedBeadInSphere<2>{detail::with_bead<2>(basis, bead), relaxation});
  }
  if (size == 1)
    return visit(BallInSphere<dimension, 1, true>{{detail::with_bead<1>(basis, bead), relaxation}, true});
  const auto ordered = std::span(all).first(size);
  detail::put_farthest_first(motion, ordered);
  if (!detail::may_be_relaxed(motion, ordered, bead)) return visit_exact();
  if (size == full) {
    return visit(BallInSphere<dimension, full, true>{
        {all, relaxation}, true, orientation * detail::sign_of_order(ordered)});
  }
  if constexpr (full == 4) {
    if (size == 3)
      return visit(BallInSphere<3, 3, true>{{detail::with_bead<3>(ordered, bead), relaxation}, true});
  }
  return visit(BallInSphere<dimension, 2, true>{{detail::with_bead<2>(ordered, bead), relaxation}, true});
}

}  // namespace kds
