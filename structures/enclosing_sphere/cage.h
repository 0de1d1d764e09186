#pragma once
// The sphere of a node of a hierarchy, in the form that its loops use, four at once in lanes. Distances and
// radii are rounded up.

#include <array>
#include <cstddef>
#include <cstdint>

#include "motions/numbers/lanes.h"
#include "structures/enclosing_sphere/sphere_of_points.h"
#include "structures/necklace/balls.h"

namespace kds {

template <int Dimension>
using Cage = BallRow<Dimension>;

/// Converts a cage for output. If the cage encloses centres only, `wider` is the common radius of the beads;
/// it is added to the radius.
template <int Dimension>
[[nodiscard]] Sphere sphere_of(const Cage<Dimension>& cage, double wider) {
  Sphere sphere;
  for (std::size_t axis = 0; axis < Dimension; ++axis)
    sphere.center[static_cast<Eigen::Index>(axis)] = cage.center[axis];
  sphere.radius = cage.radius + wider;
  return sphere;
}

/// Four indices in an array of rows. An array of four pointers would make g++ 12 compute the addresses in a
/// vector and extract them one by one.
using FourIndices = std::array<std::uint32_t, Lanes::width>;

/// Stores four rows of four numbers: row i receives lane i of each vector. If indices coincide, the last row
/// stays.
template <class OfFourDoubles>
[[gnu::always_inline]] inline void store_rows(const Lanes& a, const Lanes& b, const Lanes& c, const Lanes& d,
                                              OfFourDoubles* rows, const FourIndices& indices) {
  static_assert(sizeof(OfFourDoubles) == sizeof(Lanes::Vector));
  using Row = double __attribute__((vector_size(32), aligned(8), may_alias));
  const auto put = [&](std::size_t lane, Lanes::Vector numbers) __attribute__((always_inline)) {
    *reinterpret_cast<Row*>(rows + indices[lane]) = numbers;
  };
  const Lanes::Vector ab_even = __builtin_shufflevector(a.v, b.v, 0, 4, 2, 6);
  const Lanes::Vector ab_odd = __builtin_shufflevector(a.v, b.v, 1, 5, 3, 7);
  const Lanes::Vector cd_even = __builtin_shufflevector(c.v, d.v, 0, 4, 2, 6);
  const Lanes::Vector cd_odd = __builtin_shufflevector(c.v, d.v, 1, 5, 3, 7);
  put(0, __builtin_shufflevector(ab_even, cd_even, 0, 1, 4, 5));
  put(1, __builtin_shufflevector(ab_odd, cd_odd, 0, 1, 4, 5));
  put(2, __builtin_shufflevector(ab_even, cd_even, 2, 3, 6, 7));
  put(3, __builtin_shufflevector(ab_odd, cd_odd, 2, 3, 6, 7));
}

/// Four balls or spheres in lanes, loaded from rows and stored to rows with one load and one store each.
template <int Dimension>
struct FourBalls {
  using Vector = Lanes::Vector;
  static_assert(sizeof(BallRow<Dimension>) == sizeof(Vector));

  std::array<Lanes, static_cast<std::size_t>(Dimension)> center;
  Lanes radius;

  FourBalls() = default;
  [[gnu::always_inline]] FourBalls(const BallRow<Dimension>* rows, const FourIndices& indices) {
    const Vector a = Lanes::load(rows[indices[0]].center.data()),
                 b = Lanes::load(rows[indices[1]].center.data()),
                 c = Lanes::load(rows[indices[2]].center.data()),
                 d = Lanes::load(rows[indices[3]].center.data());
    const Vector ab_even = __builtin_shufflevector(a, b, 0, 4, 2, 6);
    const Vector ab_odd = __builtin_shufflevector(a, b, 1, 5, 3, 7);
    const Vector cd_even = __builtin_shufflevector(c, d, 0, 4, 2, 6);
    const Vector cd_odd = __builtin_shufflevector(c, d, 1, 5, 3, 7);
    center[0].v = __builtin_shufflevector(ab_even, cd_even, 0, 1, 4, 5);
    center[1].v = __builtin_shufflevector(ab_odd, cd_odd, 0, 1, 4, 5);
    const Vector third = __builtin_shufflevector(ab_even, cd_even, 2, 3, 6, 7);
    if constexpr (Dimension == 3) {
      center[2].v = third;
      radius.v = __builtin_shufflevector(ab_odd, cd_odd, 2, 3, 6, 7);
    } else {
      radius.v = third;
    }
  }
  /// Stores each lane into its row. If indices coincide, the last lane stays.
  [[gnu::always_inline]] void store(BallRow<Dimension>* rows, const FourIndices& indices) const {
    store_rows(center[0], center[1], Dimension == 3 ? center[Dimension - 1] : radius, radius, rows, indices);
  }
};

/// Returns at least |a - b|. The excess is below 2^-48 of the result or of the least normal number. Infinite
/// on overflow.
template <int Dimension>
[[nodiscard]] double distance_rounded_up(const Point<Dimension>& a, const Point<Dimension>& b);

/// Returns at least |a - b| + r, the distance from a to the farthest point of the ball. r is not negative.
template <int Dimension>
[[nodiscard]] double reach_rounded_up(const Point<Dimension>& a, const Point<Dimension>& b, double r) {
  return (distance_rounded_up<Dimension>(a, b) + r) * (1 + 0x1p-51);  // the sum has a relative error of 2^-53
}

}  // namespace kds
