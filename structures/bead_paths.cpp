#include "structures/bead_paths.h"

#include <algorithm>
#include <cmath>

#include "motions/lanes.h"

namespace kds {

namespace {

struct Range {
  double least, most;
};

/// Of a column whose padding holds its first number.
[[KDS_LANES_TARGETS]] void find_range(const double* column, std::size_t count, Range& range) {
  Lanes low(column[0]), high(column[0]);
  for (std::size_t b = 0; b < count; b += Lanes::width) {
    const Lanes four(Lanes::load(column + b));
    low = Lanes::min(low, four);
    high = Lanes::max(high, four);
  }
  range = {low.v[0], high.v[0]};
  for (std::size_t lane = 1; lane < Lanes::width; ++lane) {
    range.least = std::min(range.least, low.v[lane]);
    range.most = std::max(range.most, high.v[lane]);
  }
}

}  // namespace

template <int Dimension>
void BeadPaths<Dimension>::measure() {
  extent_ = 0;
  equal_radii_ = true;
  if (beads_ == 0) return;
  for (int k = 0; k <= degree_; ++k) {
    for (int axis = 0; axis <= Dimension; ++axis) {
      std::vector<double>& column = columns_[place(k, axis)];
      std::fill(column.end() - static_cast<std::ptrdiff_t>(padding), column.end(), column.front());
      Range range{};
      find_range(column.data(), beads_, range);
      extent_ = std::max(extent_, range.most - range.least);
      if (axis == Dimension) equal_radii_ = equal_radii_ && range.least == range.most;
    }
  }
}

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
