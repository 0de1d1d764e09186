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

#include "certificates/base/gram_matrix.h"
#include "certificates/conservative/piece_view.h"

namespace kds {

template <int Dimension>
struct CageSphere {
  std::array<MeanValue, static_cast<std::size_t>(Dimension)> center;  ///< minus that of the basis' first bead
  MeanValue radius;
};

template <Motion M>
[[nodiscard]] std::optional<CageSphere<M::dimension>> cage_sphere(const PieceView<M>& view,
                                                                  std::span<const BeadId> basis) {
  using Row = GramMatrix<MeanValue>::Row;
  CageSphere<M::dimension> sphere;
  sphere.radius = view.radius(basis[0]);
  if (basis.size() == 1) return sphere;

  const auto positive = [](const MeanValue& x) { return x.range.lower > 0; };
  const std::size_t m = basis.size() - 1;
  std::array<typename PieceView<M>::Vector, 3> d;
  for (std::size_t i = 0; i < m; ++i) d[i] = view.difference(basis[i + 1], basis[0]);
  const GramMatrix<MeanValue> gram(d, m);
  const MeanValue& g = gram.determinant();
  if (!positive(g)) return std::nullopt;
  Row s, e;
  for (std::size_t i = 0; i < m; ++i) {
    s[i] = view.radius_difference(basis[i + 1], basis[0]);
    e[i] = MeanValue(0.5) * (gram(i, i) - square(s[i]));
  }
  const Row ae = gram.times_adjugate(e);
  const Row as = gram.times_adjugate(s);
  const MeanValue b = gram.dot(e, as);
  const MeanValue c = gram.dot(e, ae);
  const MeanValue discriminant = g * (c - gram.skew(e, s));
  if (!positive(discriminant)) return std::nullopt;
  const MeanValue denominator = sqrt(discriminant) - b;
  if (!positive(denominator)) return std::nullopt;
  const MeanValue rho = c / denominator;
  for (std::size_t i = 0; i < m; ++i) {
    if (!(rho.range.lower >= std::max(0.0, s[i].range.upper))) return std::nullopt;
  }
  for (std::size_t i = 0; i < m; ++i) {
    const MeanValue share = (ae[i] + as[i] * rho) / g;
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
