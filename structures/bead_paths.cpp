#include "structures/bead_paths.h"

#include <algorithm>
#include <cmath>

namespace kds {

// The distance is at least that along the sum of both ends' differences, by control points. Where it is no
// small part of them the roundings, below 2^-45 of them, do not matter.
template <int Dimension>
bool BeadPaths<Dimension>::are_apart(BeadId a, BeadId b) const {
  using Vector = std::array<double, static_cast<std::size_t>(Dimension)>;
  constexpr double up = 1 + 0x1p-30, part = 0x1p-10;
  std::array<Vector, most_degree + 1> d;
  double limit = 0;  // the greatest square of a difference of radii, or of a part of d
  for (int k = 0; k <= degree_; ++k) {
    double square = 0;
    for (int axis = 0; axis < Dimension; ++axis) {
      const double x = column(k, axis)[b] - column(k, axis)[a];
      d[static_cast<std::size_t>(k)][static_cast<std::size_t>(axis)] = x;
      square += x * x;
    }
    const double s = column(k, Dimension)[b] - column(k, Dimension)[a];
    limit = std::max({limit, s * s, part * part * square});
  }
  Vector along;
  double length = 0, least = HUGE_VAL;
  const auto last = static_cast<std::size_t>(degree_);
  for (std::size_t axis = 0; axis < along.size(); ++axis) {
    along[axis] = d[0][axis] + d[last][axis];
    length += along[axis] * along[axis];
  }
  for (std::size_t k = 0; k <= last; ++k) {
    double product = 0;
    for (std::size_t axis = 0; axis < along.size(); ++axis) product += along[axis] * d[k][axis];
    least = std::min(least, product);
  }
  // Away from overflow and from subnormal numbers.
  return extent_ < 0x1p150 && limit > 0x1p-300 && least > 0 && least * least > limit * length * up;
}

template class BeadPaths<2>;
template class BeadPaths<3>;

}  // namespace kds
