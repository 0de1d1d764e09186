#pragma once
// Scans consecutive beads against a sphere, eight at a time: how far the farthest sticks out, and how many
// are not certainly inside. Basis beads are always counted, so a sphere contains all beads if the count
// equals the size of the basis. Every operation is rounded as written and the result does not depend on the
// order of beads, so all machines give the same bits.

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>

#include "structures/enclosing_sphere/sphere_of_balls.h"
#include "structures/enclosing_sphere/sphere_of_points.h"

// Attributes of functions that loop over beads: like KDS_LANES_TARGETS (motions/numbers/lanes.h), with a
// further clone for vectors of eight.
#if defined(__x86_64__) && defined(__OPTIMIZE__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define KDS_SCAN_TARGETS gnu::target_clones("avx512f", "avx2", "default"), gnu::flatten, gnu::noinline
#else
#define KDS_SCAN_TARGETS gnu::noinline
#endif

namespace kds {

namespace detail {

using Eight = double __attribute__((vector_size(64)));
using EightFlags = decltype(Eight{} < Eight{});  // integers: -1 for true, else 0

[[gnu::always_inline]] inline Eight load(const double* eight) {
  Eight v;
  __builtin_memcpy(&v, eight, sizeof v);
  return v;
}
[[gnu::always_inline]] inline Eight all(double x) { return Eight{} + x; }
/// Returns zero for the first `count` of eight lanes, and a value that removes the bead from the count for
/// the others.
[[gnu::always_inline]] inline Eight only_first(std::size_t count) {
  static constexpr double no = -HUGE_VAL;
  alignas(64) static constexpr std::array<double, 16> table{0,  0,  0,  0,  0,  0,  0,  0,
                                                            no, no, no, no, no, no, no, no};
  return load(table.data() + (8 - count));
}

/// Returns one bit per lane.
[[gnu::always_inline]] inline unsigned bits_of(const EightFlags& flags) {
  constexpr EightFlags bit{1, 2, 4, 8, 16, 32, 64, 128};
  const EightFlags some = flags & bit;
  const auto four =
      __builtin_shufflevector(some, some, 0, 1, 2, 3) | __builtin_shufflevector(some, some, 4, 5, 6, 7);
  const auto two = __builtin_shufflevector(four, four, 0, 1) | __builtin_shufflevector(four, four, 2, 3);
  return static_cast<unsigned>(two[0] | two[1]);
}

template <int Dimension>
[[gnu::always_inline]] inline Eight square_distance(const std::array<const double*, Dimension>& centers,
                                                    std::size_t b, const Point<Dimension>& center) {
  Eight sum{};
  for (std::size_t axis = 0; axis < Dimension; ++axis) {
    const Eight d = load(centers[axis] + b) - center[axis];
    sum = axis == 0 ? d * d : sum + d * d;
  }
  return sum;
}

/// Measures a bead: the squared distance of a point, the excess of a ball. `taken` is added if not all eight
/// lanes are valid.
template <int Dimension>
struct PointMeasure {
  std::array<const double*, static_cast<std::size_t>(Dimension)> centers;
  Point<Dimension> center;
  double inner;
  [[gnu::always_inline]] Eight operator()(std::size_t b, EightFlags& outside, const Eight& taken) const {
    const Eight t = square_distance<Dimension>(centers, b, center) + taken;
    outside = t > inner;
    return t;
  }
  [[gnu::always_inline]] Eight operator()(std::size_t b, EightFlags& outside) const {
    const Eight t = square_distance<Dimension>(centers, b, center);
    outside = t > inner;
    return t;
  }
};
template <int Dimension>
struct BallMeasure {
  std::array<const double*, static_cast<std::size_t>(Dimension)> centers;
  const double* radii;
  Point<Dimension> center;
  double inner;
  [[gnu::always_inline]] Eight operator()(std::size_t b, EightFlags& outside, const Eight& taken) const {
    const Eight t = square_distance<Dimension>(centers, b, center) + taken;
    const Eight room = inner - (load(radii + b) + taken);
    // If the room is below 2^-200, its square may have lost digits. Then no squared distance counts as small
    // enough.
    const Eight none = all(-1.0);
    const Eight square = room * room;
    const Eight limit = room >= 0x1p-200 ? square * (1 - 32 * unit_roundoff) : none;
    outside = t > limit;
    return t - (room < 0.0 ? -square : square);
  }
  [[gnu::always_inline]] Eight operator()(std::size_t b, EightFlags& outside) const {
    return (*this)(b, outside, Eight{});
  }
};

template <int Dimension>
[[gnu::always_inline]] inline std::array<const double*, Dimension> coordinates_of(
    const Balls<Dimension>& balls) {
  std::array<const double*, Dimension> c;
  for (std::size_t axis = 0; axis < Dimension; ++axis) c[axis] = balls.coordinates(axis);
  return c;
}

/// Counts the beads that are not certainly inside, over several runs of beads.
class OutsideCount {
 public:
  template <class Measure>
  [[gnu::always_inline]] void scan(const Measure& measure, std::size_t first, std::size_t last) {
    EightFlags flags;
    for (; first + 7 <= last; first += 8) {
      measure(first, flags);
      sum_ += flags;
    }
    if (first > last) return;
    measure(first, flags, only_first(last - first + 1));
    sum_ += flags;
  }
  [[gnu::always_inline]] std::size_t result() const {
    const auto four =
        __builtin_shufflevector(sum_, sum_, 0, 1, 2, 3) + __builtin_shufflevector(sum_, sum_, 4, 5, 6, 7);
    const auto two = __builtin_shufflevector(four, four, 0, 1) + __builtin_shufflevector(four, four, 2, 3);
    return static_cast<std::size_t>(-(two[0] + two[1]));
  }

 private:
  EightFlags sum_{};  // minus the count of each lane, because a set flag is -1
};

/// Finds how far out the farthest bead is, over several runs: squared distance for points, excess for balls.
class Farthest {
 public:
  template <class Measure>
  [[gnu::always_inline]] void scan(const Measure& measure, std::size_t first, std::size_t last) {
    EightFlags flags;
    for (; first + 7 <= last; first += 8) {
      const Eight value = measure(first, flags);
      most_ = value > most_ ? value : most_;
    }
    if (first > last) return;
    const Eight value = measure(first, flags, only_first(last - first + 1));
    most_ = value > most_ ? value : most_;
  }
  [[gnu::always_inline]] double result() const {
    const auto greater = [](const auto& a, const auto& b) { return a > b ? a : b; };
    const auto four = greater(__builtin_shufflevector(most_, most_, 0, 1, 2, 3),
                              __builtin_shufflevector(most_, most_, 4, 5, 6, 7));
    const auto two =
        greater(__builtin_shufflevector(four, four, 0, 1), __builtin_shufflevector(four, four, 2, 3));
    return two[0] > two[1] ? two[0] : two[1];
  }

 private:
  Eight most_ = all(-HUGE_VAL);
};

/// Returns the first bead of first..last with this value, or no_bead.
template <class Measure>
[[gnu::always_inline]] inline BeadId find_value(const Measure& measure, std::size_t first, std::size_t last,
                                                double value) {
  for (; first <= last; first += 8) {
    EightFlags flags;
    const std::size_t count = std::min<std::size_t>(last - first + 1, 8);
    const unsigned equal = bits_of(measure(first, flags, only_first(count)) == value);
    if (equal != 0) return static_cast<BeadId>(first + static_cast<std::size_t>(std::countr_zero(equal)));
  }
  return no_bead;
}

}  // namespace detail

// Two forms of balls for the search for a minimum enclosing sphere: points, for equal radii, or balls.

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
