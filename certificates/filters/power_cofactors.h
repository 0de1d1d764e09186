#pragma once
// Cofactors of power tests (power_test.h). The tests of one cell's beads against one more bead each share all
// rows of their determinant except the last, so the cofactors of the last row are computed once. Works over
// any number type.

#include <array>
#include <cstddef>

#include "certificates/base/determinant.h"
#include "certificates/types/power_test.h"

namespace kds {

/// A row of the determinant: the differences of one bead from another.
template <class View>
struct PowerRow {
  static constexpr int lift_degree = LiftedView<View> ? 1 : 2 * View::degree;

  BernsteinVector<typename View::Number, View::degree, View::dimension> centre;
  Bernstein<typename View::Number, lift_degree> lift;

  [[gnu::always_inline]] PowerRow(const View& view, BeadId x, BeadId p) : centre(view.difference(x, p)) {
    lift = power_lift(view, x, p, centre);
  }
};

/// The cofactors of the last row's entries, including signs.
template <class View>
struct PowerCofactors {
  static constexpr int dimension = View::dimension;
  using Number = typename View::Number;
  using Row = PowerRow<View>;
  static constexpr int of_centre = (dimension - 1) * View::degree + Row::lift_degree;

  std::array<Bernstein<Number, of_centre>, dimension> centre;
  Bernstein<Number, dimension * View::degree> lift;

  /// Takes the rows of a triangle's second and third bead relative to its first.
  [[gnu::always_inline]] PowerCofactors(const Row& a, const Row& b) requires(dimension == 2) {
    centre[0] = minor(a.centre[1], a.lift, b.centre[1], b.lift);
    centre[1] = minor(b.centre[0], b.lift, a.centre[0], a.lift);
    lift = minor(a.centre[0], a.centre[1], b.centre[0], b.centre[1]);
  }
  /// Takes the rows of a tetrahedron's other beads relative to its first.
  [[gnu::always_inline]] PowerCofactors(const Row& a, const Row& b, const Row& c) requires(dimension == 3) {
    const auto xy = minor(a.centre[0], a.centre[1], b.centre[0], b.centre[1]);
    const auto xz = minor(a.centre[0], a.centre[2], b.centre[0], b.centre[2]);
    const auto yz = minor(a.centre[1], a.centre[2], b.centre[1], b.centre[2]);
    const auto xl = minor(a.centre[0], a.lift, b.centre[0], b.lift);
    const auto yl = minor(a.centre[1], a.lift, b.centre[1], b.lift);
    const auto zl = minor(a.centre[2], a.lift, b.centre[2], b.lift);
    centre[0] = yl * c.centre[2] - yz * c.lift - zl * c.centre[1];
    centre[1] = xz * c.lift - xl * c.centre[2] + zl * c.centre[0];
    centre[2] = xl * c.centre[1] - xy * c.lift - yl * c.centre[0];
    lift = xy * c.centre[2] - xz * c.centre[1] + yz * c.centre[0];
  }

  /// Returns the power test of the cell's beads, in their order, with the bead of this row.
  [[nodiscard, gnu::always_inline]] auto with(const Row& row) const {
    auto sum = lift * row.lift;
    for (std::size_t axis = 0; axis < dimension; ++axis) sum += centre[axis] * row.centre[axis];
    return sum;
  }
};

}  // namespace kds
