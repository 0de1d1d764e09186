#pragma once
// Four balls or spheres side by side, from rows and to rows: one load and one store each.

#include <array>
#include <cstddef>

#include "motions/numbers/lanes.h"
#include "structures/necklace/ball_rows.h"

namespace kds {

template <int Dimension>
struct FourBalls {
  using Vector = Lanes::Vector;
  static_assert(sizeof(BallRow<Dimension>) == sizeof(Vector));
  using Rows = std::array<const BallRow<Dimension>*, Lanes::width>;

  std::array<Lanes, static_cast<std::size_t>(Dimension)> center;
  Lanes radius;

  FourBalls() = default;
  [[gnu::always_inline]] explicit FourBalls(const Rows& rows) {
    const Vector a = Lanes::load(rows[0]->center.data()), b = Lanes::load(rows[1]->center.data()),
                 c = Lanes::load(rows[2]->center.data()), d = Lanes::load(rows[3]->center.data());
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
  /// Where lanes are of the same row, the last of them stays.
  [[gnu::always_inline]] void store(const std::array<BallRow<Dimension>*, Lanes::width>& rows) const {
    const Vector x = center[0].v, y = center[1].v, z = Dimension == 3 ? center[Dimension - 1].v : radius.v,
                 r = radius.v;
    const Vector xy_even = __builtin_shufflevector(x, y, 0, 4, 2, 6);
    const Vector xy_odd = __builtin_shufflevector(x, y, 1, 5, 3, 7);
    const Vector zr_even = __builtin_shufflevector(z, r, 0, 4, 2, 6);
    const Vector zr_odd = __builtin_shufflevector(z, r, 1, 5, 3, 7);
    put(rows[0], __builtin_shufflevector(xy_even, zr_even, 0, 1, 4, 5));
    put(rows[1], __builtin_shufflevector(xy_odd, zr_odd, 0, 1, 4, 5));
    put(rows[2], __builtin_shufflevector(xy_even, zr_even, 2, 3, 6, 7));
    put(rows[3], __builtin_shufflevector(xy_odd, zr_odd, 2, 3, 6, 7));
  }

 private:
  [[gnu::always_inline]] static void put(BallRow<Dimension>* row, Vector numbers) {
    using Row = double __attribute__((vector_size(32), aligned(8), may_alias));
    *reinterpret_cast<Row*>(row) = numbers;
  }
};

}  // namespace kds
