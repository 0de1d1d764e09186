#pragma once
// Determinants of polynomials, by Laplace expansion over 2x2 minors, and Gram matrices. Exact if the number
// type is.

#include <array>
#include <cstddef>

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

/// The Gram matrix G of up to three vectors, its determinant g and its adjugate A. G, g and A express the
/// sphere that touches a set of balls without divisions (certificates/types/ball_in_sphere.h), in integers
/// and in enclosures.
template <class Number>
class GramMatrix {
 public:
  using Row = std::array<Number, 3>;  // entries beyond the size are unused

  /// Takes the first `size` vectors, 1 to 3.
  template <std::size_t Dimension>
  GramMatrix(const std::array<std::array<Number, Dimension>, 3>& vectors, std::size_t size) : size_(size) {
    for (std::size_t i = 0; i < size; ++i) {
      for (std::size_t j = 0; j <= i; ++j)
        entry_[i][j] = entry_[j][i] = product(vectors[i], vectors[j], Dimension);
    }
    adjoin();
  }

  [[nodiscard]] const Number& operator()(std::size_t i, std::size_t j) const { return entry_[i][j]; }
  [[nodiscard]] const Number& determinant() const { return determinant_; }

  /// Returns v.w.
  [[nodiscard]] Number dot(const Row& v, const Row& w) const { return product(v, w, size_); }
  /// Returns A v.
  [[nodiscard]] Row times_adjugate(const Row& v) const {
    Row result;
    for (std::size_t i = 0; i < size_; ++i) result[i] = product(adjugate_[i], v, size_);
    return result;
  }

 private:
  template <std::size_t N>
  [[nodiscard]] static Number product(const std::array<Number, N>& a, const std::array<Number, N>& b,
                                      std::size_t count) {
    Number sum = a[0] * b[0];
    for (std::size_t i = 1; i < count; ++i) sum = sum + a[i] * b[i];
    return sum;
  }

  void adjoin() {
    const auto& g = entry_;
    if (size_ == 1) {
      adjugate_[0][0] = Number(1);
      determinant_ = g[0][0];
    } else if (size_ == 2) {
      adjugate_[0][0] = g[1][1];
      adjugate_[0][1] = adjugate_[1][0] = Number(0) - g[0][1];
      adjugate_[1][1] = g[0][0];
      determinant_ = g[0][0] * g[1][1] - g[0][1] * g[0][1];
    } else {
      for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = i; j < 3; ++j) {
          const std::size_t a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
          adjugate_[i][j] = adjugate_[j][i] = g[a][c] * g[b][d] - g[a][d] * g[b][c];
        }
      }
      determinant_ = product(g[0], adjugate_[0], 3);
    }
  }

  std::array<Row, 3> entry_{}, adjugate_{};
  Number determinant_{};
  std::size_t size_;
};

}  // namespace kds
