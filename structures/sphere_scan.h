#pragma once
// Consecutive beads against a sphere, eight at a time: how far the farthest sticks out, and how many are not
// inside for certain. Basis beads always count among these, so a sphere holds all beads if it counts no more.
// Every operation is rounded as written and the result does not depend on the order of beads: the same bits
// on every machine.

#include <bit>
#include <cstddef>

#include "structures/ball_sphere.h"
#include "structures/point_sphere.h"

namespace kds {

namespace detail {

using Eight = double __attribute__((vector_size(64)));
using EightFlags = decltype(Eight{} < Eight{});  // of whole numbers: -1 where true, else 0

[[gnu::always_inline]] inline Eight load(const double* eight) {
  Eight v;
  __builtin_memcpy(&v, eight, sizeof v);
  return v;
}
[[gnu::always_inline]] inline Eight all(double x) { return Eight{} + x; }
/// The first `count` of eight.
[[gnu::always_inline]] inline EightFlags first_of_eight(std::size_t count) {
  constexpr EightFlags place{0, 1, 2, 3, 4, 5, 6, 7};
  return place < static_cast<long long>(count);
}

/// One bit each.
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

/// What is looked at of each bead: the square distance of a point, the excess of a ball.
template <int Dimension>
struct PointMeasure {
  std::array<const double*, Dimension> centers;
  Point<Dimension> center;
  double inner;
  [[gnu::always_inline]] Eight operator()(std::size_t b, EightFlags& outside) const {
    const Eight t = square_distance<Dimension>(centers, b, center);
    outside = t > inner;
    return t;
  }
};
template <int Dimension>
struct BallMeasure {
  std::array<const double*, Dimension> centers;
  const double* radii;
  Point<Dimension> center;
  double inner;
  [[gnu::always_inline]] Eight operator()(std::size_t b, EightFlags& outside) const {
    const Eight t = square_distance<Dimension>(centers, b, center);
    const Eight room = inner - load(radii + b);
    const Eight square = room * room;
    // Below 2^-200 of room a square may have lost its digits.
    outside = ~((room >= 0x1p-200) & (t <= square * (1 - 32 * unit_roundoff)));
    return t - (room < 0.0 ? -square : square);
  }
};

template <int Dimension>
[[gnu::always_inline]] inline std::array<const double*, Dimension> coordinates_of(
    const Balls<Dimension>& balls) {
  std::array<const double*, Dimension> c;
  for (std::size_t axis = 0; axis < Dimension; ++axis) c[axis] = balls.coordinates(axis);
  return c;
}

/// Gathers over several runs of beads how far the farthest is out (points: its square distance, balls: their
/// excess) and how many are not inside for certain.
struct Scanner {
  Eight farthest = all(-HUGE_VAL);
  EightFlags outside{};  // beads that are not inside for certain, negative

  template <class Measure>
  [[gnu::always_inline]] void scan(const Measure& measure, std::size_t first, std::size_t last) {
    EightFlags flags;
    for (; first + 7 <= last; first += 8) {
      const Eight value = measure(first, flags);
      farthest = value > farthest ? value : farthest;
      outside += flags;
    }
    if (first <= last) {
      const EightFlags some = first_of_eight(last - first + 1);
      const Eight value = measure(first, flags);
      farthest = (value > farthest) & some ? value : farthest;
      outside += flags & some;
    }
  }
  [[gnu::always_inline]] std::size_t outside_count() const {
    const auto four = __builtin_shufflevector(outside, outside, 0, 1, 2, 3) +
                      __builtin_shufflevector(outside, outside, 4, 5, 6, 7);
    const auto two = __builtin_shufflevector(four, four, 0, 1) + __builtin_shufflevector(four, four, 2, 3);
    return static_cast<std::size_t>(-(two[0] + two[1]));
  }
  [[gnu::always_inline]] double farthest_value() const {
    const auto greater = [](const auto& a, const auto& b) { return a > b ? a : b; };
    const auto four = greater(__builtin_shufflevector(farthest, farthest, 0, 1, 2, 3),
                              __builtin_shufflevector(farthest, farthest, 4, 5, 6, 7));
    const auto two =
        greater(__builtin_shufflevector(four, four, 0, 1), __builtin_shufflevector(four, four, 2, 3));
    return two[0] > two[1] ? two[0] : two[1];
  }
};

/// The first bead of first..last with this value, or no_bead.
template <class Measure>
[[gnu::always_inline]] inline BeadId find_value(const Measure& measure, std::size_t first, std::size_t last,
                                                double value) {
  for (; first <= last; first += 8) {
    EightFlags flags;
    const unsigned equal = bits_of((measure(first, flags) == value) & first_of_eight(last - first + 1));
    if (equal != 0) return static_cast<BeadId>(first + static_cast<std::size_t>(std::countr_zero(equal)));
  }
  return no_bead;
}

}  // namespace detail

}  // namespace kds
