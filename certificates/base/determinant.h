#pragma once
// Determinants of polynomials by Laplace expansion over 2x2 minors. Exact if the number type is.

#include "motions/numbers/bernstein.h"

namespace kds {

/// Returns a0 b1 - a1 b0.
template <class P, class Q>
[[nodiscard]] constexpr auto minor(const P& a0, const Q& a1, const P& b0, const Q& b1) {
  return a0 * b1 - a1 * b0;
}

/// Returns the cross product.
template <class Number, int A, int B>
[[nodiscard]] constexpr BernsteinVector<Number, A + B, 3> cross(const BernsteinVector<Number, A, 3>& a,
                                                                const BernsteinVector<Number, B, 3>& b) {
  return {minor(a[1], a[2], b[1], b[2]), minor(a[2], a[0], b[2], b[0]), minor(a[0], a[1], b[0], b[1])};
}

/// Returns the determinant of three rows.
template <class Number, int Degree>
[[nodiscard]] constexpr auto determinant(const BernsteinVector<Number, Degree, 3>& a,
                                         const BernsteinVector<Number, Degree, 3>& b,
                                         const BernsteinVector<Number, Degree, 3>& c) {
  return minor(a[0], a[1], b[0], b[1]) * c[2] - minor(a[0], a[1], c[0], c[1]) * b[2] +
         minor(b[0], b[1], c[0], c[1]) * a[2];
}

/// Returns the determinant of three rows (x, y, l), where l has a degree of its own.
template <class Number, int Degree, int Last>
[[nodiscard]] constexpr auto determinant(const std::array<BernsteinVector<Number, Degree, 2>, 3>& row,
                                         const std::array<Bernstein<Number, Last>, 3>& l) {
  const auto xy = [&](int i, int j) { return minor(row[i][0], row[i][1], row[j][0], row[j][1]); };
  return xy(0, 1) * l[2] - xy(0, 2) * l[1] + xy(1, 2) * l[0];
}

/// Returns the determinant of four rows (x, y, z, l), where l has a degree of its own.
template <class Number, int Degree, int Last>
[[nodiscard]] constexpr auto determinant(const std::array<BernsteinVector<Number, Degree, 3>, 4>& row,
                                         const std::array<Bernstein<Number, Last>, 4>& l) {
  const auto xy = [&](int i, int j) { return minor(row[i][0], row[i][1], row[j][0], row[j][1]); };
  const auto zl = [&](int i, int j) { return minor(row[i][2], l[i], row[j][2], l[j]); };
  return xy(0, 1) * zl(2, 3) - xy(0, 2) * zl(1, 3) + xy(0, 3) * zl(1, 2) + xy(1, 2) * zl(0, 3) -
         xy(1, 3) * zl(0, 2) + xy(2, 3) * zl(0, 1);
}

}  // namespace kds
