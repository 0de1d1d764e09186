#pragma once
// Static regular triangulations of exact positions, for audits between events and for rebuilds.

#include <gmp.h>
#include <array>
#include <cstddef>
#include <span>

#include "motions/numbers/exact_number.h"
#include "structures/triangulation/regular_triangulation.h"

namespace kds {

/// The integer coordinates of a point, followed by its weight.
template <int Dimension>
using WholePoint = std::array<mpz_srcptr, static_cast<std::size_t>(Dimension) + 1>;

/// The exact sign of a power test of points whose coordinates and weights are integers. Rebuilds between
/// events need it thousands of times if beads lie regularly. Integers of any length are stored in memory that
/// is reused for each test.
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

/// Exact position and weight of a bead at one time.
struct ExactBead {
  std::array<Rational, 3> center;
  Rational weight;
};

/// Returns the triangulation built by CGAL with exact numbers. If `oriented`, infinite cells are included and
/// cells keep their orientation; otherwise the result has the same form as the one built from doubles.
template <int Dimension>
[[nodiscard]] StaticTriangulation<Dimension> static_triangulation(std::span<const ExactBead> beads,
                                                                  bool oriented);

}  // namespace kds
