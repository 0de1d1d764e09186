#include "structures/bead_paths.h"

#include <algorithm>

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

template class BeadPaths<2>;
template class BeadPaths<3>;

}  // namespace kds
