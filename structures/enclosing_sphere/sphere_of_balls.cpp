#include "structures/enclosing_sphere/sphere_of_balls.h"

#include <bit>

namespace kds {

namespace {

constexpr double slack = 1e-12;  // relative to the squared radius; the result is verified later

Basis without_bead_at(Basis basis, std::size_t index) {
  erase_bead_at(basis, index);
  return basis;
}

template <int Dimension>
BasisSphere<double, Dimension> sphere_of_basis(const Balls<Dimension>& balls, const Basis& basis) {
  return visit_size<Dimension>(
      basis.size, [&](auto m) { return detail::sphere_of_balls(detail::basis_balls<m>(balls, basis)); });
}

template <int Dimension>
bool holds_all(const Balls<Dimension>& balls, const BasisSphere<double, Dimension>& sphere,
               const Basis& basis, BeadId escaped) {
  const auto inside = [&](BeadId b) {
    const Point<Dimension> d = detail::minus(detail::center_of(balls, b), sphere.center);
    const double room = sphere.radius * (1 + slack) - balls.radius(b);
    return room >= 0 && detail::dot(d, d) <= room * room + slack * sphere.radius * sphere.radius;
  };
  return inside(escaped) && std::all_of(basis.begin(), basis.end(), inside);
}

/// Returns the index in a full basis of the ball that is likely to leave.
template <int Dimension>
std::size_t index_to_leave(const Balls<Dimension>& balls, const Basis& basis, BeadId escaped) {
  Basis guess = basis;
  if (!pivot_points(balls, guess, escaped)) return 0;
  for (std::size_t i = 0; i < basis.size; ++i)
    if (!guess.contains(basis.beads[i])) return i;
  return 0;
}

}  // namespace

template <int Dimension>
bool pivot_balls(const Balls<Dimension>& balls, Basis& basis, BeadId escaped) {
  Basis next =
      basis.size <= Dimension ? basis : without_bead_at(basis, index_to_leave(balls, basis, escaped));
  insert_bead(next, escaped);
  while (true) {
    const auto sphere = sphere_of_basis(balls, next);
    if (sphere.least > 0) {
      if (!holds_all(balls, sphere, basis, escaped)) break;
      basis = next;
      return true;
    }
    std::size_t index = 0;
    visit_size<Dimension>(next.size, [&](auto m) {
      if constexpr (m > 0) index = detail::lightest<m>(balls, next);
    });
    if (next.beads[index] == escaped || next.size == 1) break;
    erase_bead_at(next, index);
  }
  const unsigned subsets = 1U << basis.size;
  for (int size = Dimension; size >= 0; --size) {
    for (unsigned subset = 0; subset < subsets; ++subset) {
      if (std::popcount(subset) != size) continue;
      Basis candidate;
      for (std::size_t i = 0; i < basis.size; ++i)
        if ((subset >> i & 1U) != 0) candidate.beads[candidate.size++] = basis.beads[i];
      insert_bead(candidate, escaped);
      const auto sphere = sphere_of_basis(balls, candidate);
      if (sphere.least > 0 && holds_all(balls, sphere, basis, escaped)) {
        basis = candidate;
        return true;
      }
    }
  }
  return false;
}

template bool pivot_balls(const Balls<2>&, Basis&, BeadId);
template bool pivot_balls(const Balls<3>&, Basis&, BeadId);

}  // namespace kds
