#pragma once
// The exact sign of a power test of points whose coordinates and weights are integers. Rebuilds between
// events need it thousands of times if beads lie regularly. Integers of any length are stored in memory that
// is reused for each test.

#include <gmp.h>

#include <array>
#include <cstddef>

#include "motions/numbers/integer.h"

namespace kds {

/// The coordinates, followed by the weight.
template <int Dimension>
using WholePoint = std::array<mpz_srcptr, static_cast<std::size_t>(Dimension) + 1>;

template <int Dimension>
class WholePowerTest {
  static_assert(Dimension == 2 || Dimension == 3);
  static constexpr std::size_t rows = static_cast<std::size_t>(Dimension) + 1;

 public:
  /// Returns 1, 0 or -1: the sign of the determinant with rows (x-t, |x-t|^2 - w_x + w_t), where t is the
  /// last point and x runs over the other points.
  [[nodiscard]] int sign(const std::array<WholePoint<Dimension>, rows + 1>& points);

 private:
  /// Sets `minor` to a b - c d.
  static void set_minor(Integer& minor, const Integer& a, const Integer& b, const Integer& c,
                        const Integer& d);

  std::array<std::array<Integer, rows>, rows> row_;
  std::array<std::array<Integer, rows>, rows> of_pair_;  // minors of the first two columns, i < j
  Integer minor_, determinant_;
};

extern template class WholePowerTest<2>;
extern template class WholePowerTest<3>;

}  // namespace kds
