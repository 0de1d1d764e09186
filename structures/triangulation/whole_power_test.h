#pragma once
// The sign of a power test of points whose coordinates and weights are whole numbers, as rebuilds between
// events ask for it by the thousand where beads lie regularly. Exact; numbers of any length lie in room that
// is used again and again.

#include <gmp.h>

#include <array>
#include <cstddef>

#include "motions/numbers/integer.h"

namespace kds {

/// Coordinates, and the weight last.
template <int Dimension>
using WholePoint = std::array<mpz_srcptr, static_cast<std::size_t>(Dimension) + 1>;

template <int Dimension>
class WholePowerTest {
  static_assert(Dimension == 2 || Dimension == 3);
  static constexpr std::size_t rows = static_cast<std::size_t>(Dimension) + 1;

 public:
  /// 1, 0 or -1, of the determinant with rows (x-t, |x-t|^2 - w_x + w_t) for the points x before the last
  /// one, t.
  [[nodiscard]] int sign(const std::array<WholePoint<Dimension>, rows + 1>& points);

 private:
  /// a b - c d.
  static void set_minor(Integer& minor, const Integer& a, const Integer& b, const Integer& c,
                        const Integer& d);

  std::array<std::array<Integer, rows>, rows> row_;
  std::array<std::array<Integer, rows>, rows> of_pair_;  // minors of the first two columns, i < j
  Integer minor_, determinant_;
};

extern template class WholePowerTest<2>;
extern template class WholePowerTest<3>;

}  // namespace kds
