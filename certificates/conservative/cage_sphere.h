#pragma once
// The sphere of a cage over a piece of a step: the smallest that touches the balls of its basis, 1 to 4 beads
// of equal or unequal radii in the plane or in space. Enclosure, by the formulas of ball_in_sphere.h:
//
//   rho = R - r_0 = c / (sqrt(D) - b),   centre - c_0 = Q A (e + s rho) / g,   D = g (c - x.Gx)
//
// The basis is fixed. Where one of g, D and sqrt(D) - b is not certainly positive on the piece, or rho not
// certainly as large as each s_i, there is no answer.

#include <array>
#include <optional>
#include <span>

#include "certificates/conservative/piece_view.h"

namespace kds {

template <int Dimension>
struct CageSphere {
  std::array<MeanValue, static_cast<std::size_t>(Dimension)> center;  ///< minus that of the basis' first bead
  MeanValue radius;
};

namespace detail {

template <std::size_t N>
[[nodiscard]] MeanValue inner_product(const std::array<MeanValue, N>& a, const std::array<MeanValue, N>& b,
                                      std::size_t count = N) {
  MeanValue sum(0);
  for (std::size_t i = 0; i < count; ++i) sum = sum + a[i] * b[i];
  return sum;
}

/// Adjugate of a symmetric matrix of up to three rows, its determinant, and the part c - D/g of Lagrange's
/// identity.
struct GramMatrix {
  using Row = std::array<MeanValue, 3>;

  std::array<Row, 3> entry;
  std::array<Row, 3> adjugate;
  MeanValue determinant;
  std::size_t size = 0;

  void adjoin() {
    const auto& g = entry;
    if (size == 1) {
      adjugate[0][0] = MeanValue(1);
      determinant = g[0][0];
    } else if (size == 2) {
      adjugate[0] = {g[1][1], MeanValue(0) - g[0][1], MeanValue(0)};
      adjugate[1] = {adjugate[0][1], g[0][0], MeanValue(0)};
      determinant = g[0][0] * g[1][1] - square(g[0][1]);
    } else {
      for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = i; j < 3; ++j) {
          const std::size_t a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
          adjugate[i][j] = adjugate[j][i] = g[a][c] * g[b][d] - g[a][d] * g[b][c];
        }
      }
      determinant = inner_product(g[0], adjugate[0]);
    }
  }
  [[nodiscard]] Row times_adjugate(const Row& v) const {
    Row result;
    for (std::size_t i = 0; i < size; ++i) result[i] = inner_product(adjugate[i], v, size);
    return result;
  }
  /// (e.Ae s.As - (e.As)^2) / g
  [[nodiscard]] MeanValue skew(const Row& e, const Row& s) const {
    const auto x = [&](std::size_t i, std::size_t j) { return e[i] * s[j] - e[j] * s[i]; };
    if (size == 1) return MeanValue(0);
    if (size == 2) return square(x(0, 1));
    const Row cross{x(1, 2), x(2, 0), x(0, 1)};
    Row g;
    for (std::size_t i = 0; i < 3; ++i) g[i] = inner_product(entry[i], cross);
    return inner_product(g, cross);
  }
};

}  // namespace detail

template <Motion M>
[[nodiscard]] std::optional<CageSphere<M::dimension>> cage_sphere(const PieceView<M>& view,
                                                                  std::span<const BeadId> basis) {
  using Row = detail::GramMatrix::Row;
  CageSphere<M::dimension> sphere;
  sphere.radius = view.radius(basis[0]);
  if (basis.size() == 1) return sphere;

  const auto positive = [](const MeanValue& x) { return x.range.lower > 0; };
  detail::GramMatrix gram;
  gram.size = basis.size() - 1;
  std::array<typename PieceView<M>::Vector, 3> d;
  Row s, e;
  for (std::size_t i = 0; i < gram.size; ++i) {
    d[i] = view.difference(basis[i + 1], basis[0]);
    s[i] = view.radius_difference(basis[i + 1], basis[0]);
    MeanValue length(0);
    for (const MeanValue& x : d[i]) length = length + square(x);
    gram.entry[i][i] = length;
    e[i] = MeanValue(0.5) * (length - square(s[i]));
    for (std::size_t j = 0; j < i; ++j)
      gram.entry[i][j] = gram.entry[j][i] = detail::inner_product(d[i], d[j]);
  }
  gram.adjoin();
  if (!positive(gram.determinant)) return std::nullopt;
  const Row ae = gram.times_adjugate(e);
  const Row as = gram.times_adjugate(s);
  const MeanValue b = detail::inner_product(e, as, gram.size);
  const MeanValue c = detail::inner_product(e, ae, gram.size);
  const MeanValue discriminant = gram.determinant * (c - gram.skew(e, s));
  if (!positive(discriminant)) return std::nullopt;
  const MeanValue denominator = sqrt(discriminant) - b;
  if (!positive(denominator)) return std::nullopt;
  const MeanValue rho = c / denominator;
  for (std::size_t i = 0; i < gram.size; ++i) {
    if (!(rho.range.lower >= std::max(0.0, s[i].range.upper))) return std::nullopt;
  }
  for (std::size_t i = 0; i < gram.size; ++i) {
    const MeanValue share = (ae[i] + as[i] * rho) / gram.determinant;
    for (std::size_t axis = 0; axis < sphere.center.size(); ++axis)
      sphere.center[axis] = sphere.center[axis] + share * d[i][axis];
  }
  sphere.radius = sphere.radius + rho;
  return sphere;
}

/// The squared distance of two cages' centres; each is told with the first bead of its basis.
template <Motion M>
[[nodiscard]] MeanValue square_distance(const PieceView<M>& view, BeadId first_a,
                                        const CageSphere<M::dimension>& a, BeadId first_b,
                                        const CageSphere<M::dimension>& b) {
  const auto apart = view.difference(first_a, first_b);
  MeanValue sum(0);
  for (std::size_t axis = 0; axis < apart.size(); ++axis)
    sum = sum + square(apart[axis] + (a.center[axis] - b.center[axis]));
  return sum;
}

}  // namespace kds
