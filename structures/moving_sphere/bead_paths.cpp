#include "structures/moving_sphere/bead_paths.h"

#include <algorithm>
#include <cmath>

#include "motions/numbers/lanes.h"

namespace kds {

namespace {

/// The least and the greatest number of each column, in four lanes.
template <std::size_t Columns>
struct ColumnRanges {
  std::array<Lanes, Columns> low, high;
};

/// Copies coordinates into columns, one control point after another, four beads at a time while four are
/// left.
template <int K>
[[KDS_LANES_TARGETS]] void copy_columns(const FixedCurves<3, K>& curves,
                                        const std::array<double*, (K + 1) * 3>& to,
                                        ColumnRanges<(K + 1) * 3>& ranges) {
  ranges.low.fill(Lanes(HUGE_VAL));
  ranges.high.fill(Lanes(-HUGE_VAL));
  for (BeadId b = 0; b + Lanes::width <= curves.bead_count(); b += Lanes::width) {
    for (int k = 0; k <= K; ++k) {
      // The weight comes last.
      const auto axes = Lanes::transposed(curves.control_point(b, k), curves.control_point(b + 1, k),
                                          curves.control_point(b + 2, k), curves.control_point(b + 3, k));
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::size_t c = static_cast<std::size_t>(k) * 3 + axis;
        ranges.low[c] = Lanes::min(ranges.low[c], axes[axis]);
        ranges.high[c] = Lanes::max(ranges.high[c], axes[axis]);
        __builtin_memcpy(to[c] + b, &axes[axis].v, sizeof axes[axis].v);
      }
    }
  }
}

// A lower bound of the distance is its component along the sum of both ends' differences, by control points.
// The roundings are below 2^-45 of the differences. If the bound is no small part of the differences, the
// roundings do not matter.
template <int D, int K>
[[KDS_LANES_TARGETS]] void find_apart(const BeadPaths<D>& paths, std::uint8_t* apart) {
  constexpr double up = 1 + 0x1p-30, part = 0x1p-10;
  for (BeadId b = 0; b + 1 < paths.bead_count(); b += Lanes::width) {
    std::array<std::array<Lanes, D>, K + 1> d;
    Lanes limit(0.0);  // greatest square of a difference of radii, or of a part of d
    for (std::size_t k = 0; k <= K; ++k) {
      const auto to_next = [&](int axis) __attribute__((always_inline)) {
        const double* const column = paths.column(static_cast<int>(k), axis) + b;
        return Lanes(Lanes::load(column + 1)) - Lanes(Lanes::load(column));
      };
      Lanes square(0.0);
      for (std::size_t axis = 0; axis < D; ++axis) {
        d[k][axis] = to_next(static_cast<int>(axis));
        square += d[k][axis] * d[k][axis];
      }
      const Lanes s = to_next(D);
      limit = Lanes::max(limit, Lanes::max(s * s, Lanes(part * part) * square));
    }
    std::array<Lanes, D> along;
    Lanes length(0.0), least(HUGE_VAL);
    for (std::size_t axis = 0; axis < D; ++axis) {
      along[axis] = d[0][axis] + d[K][axis];
      length += along[axis] * along[axis];
    }
    for (std::size_t k = 0; k <= K; ++k) {
      Lanes product(0.0);
      for (std::size_t axis = 0; axis < D; ++axis) product += along[axis] * d[k][axis];
      least = Lanes::min(least, product);
    }
    // Excludes overflow and subnormal numbers.
    const Lanes::Mask are = (Lanes(paths.extent()) < Lanes(0x1p150)) & (limit > Lanes(0x1p-300)) &
                            (least > Lanes(0.0)) & (least * least > limit * length * Lanes(up));
    for (std::size_t lane = 0; lane < Lanes::width; ++lane) apart[b + lane] = are[lane] != 0;
  }
}

}  // namespace

template <int Dimension>
void BeadPaths<Dimension>::set(const Curves<Dimension>& curves, bool leave_out_radii) {
  degree_ = curves.own_degree();
  beads_ = curves.bead_count();
  radii_are_left_out_ = leave_out_radii;
  for (std::size_t c = 0; c < index(degree_ + 1, 0); ++c) columns_[c].resize(beads_ + padding);
  extent_ = 0;
  equal_radii_ = true;
  if (beads_ == 0) return;
  switch (degree_) {
    case 1:
      set_coordinates(FixedCurves<Dimension, 1>(curves));
      break;
    case 2:
      set_coordinates(FixedCurves<Dimension, 2>(curves));
      break;
    default:
      set_coordinates(FixedCurves<Dimension, 3>(curves));
  }
  if (!leave_out_radii) set_radii(curves);
}

template <int Dimension>
template <int K>
void BeadPaths<Dimension>::set_coordinates(const FixedCurves<Dimension, K>& curves) {
  constexpr std::size_t count = (K + 1) * Dimension;
  std::array<double*, count> to;
  for (std::size_t c = 0; c < count; ++c)
    to[c] = columns_[index(static_cast<int>(c / Dimension), static_cast<int>(c % Dimension))].data();
  std::array<double, count> low, high;
  low.fill(HUGE_VAL);
  high.fill(-HUGE_VAL);
  BeadId b = 0;
  if constexpr (Dimension == 3) {
    ColumnRanges<count> ranges;
    copy_columns(curves, to, ranges);
    b = static_cast<BeadId>(beads_ - beads_ % Lanes::width);
    for (std::size_t c = 0; c < count; ++c) {
      for (std::size_t lane = 0; lane < Lanes::width; ++lane) {
        low[c] = std::min(low[c], ranges.low[c].v[lane]);
        high[c] = std::max(high[c], ranges.high[c].v[lane]);
      }
    }
  }
  for (; b < beads_; ++b) {
    for (std::size_t c = 0; c < count; ++c) {
      const double x = curves.coordinate(b, static_cast<int>(c / Dimension), static_cast<int>(c % Dimension));
      to[c][b] = x;
      low[c] = std::min(low[c], x);
      high[c] = std::max(high[c], x);
    }
  }
  for (std::size_t c = 0; c < count; ++c) {
    std::fill_n(to[c] + beads_, padding, to[c][0]);
    extent_ = std::max(extent_, high[c] - low[c]);
  }
}

template <int Dimension>
void BeadPaths<Dimension>::set_radii(const Curves<Dimension>& curves) {
  for (int k = 0; k <= degree_; ++k) {
    double* const to = columns_[index(k, Dimension)].data();
    double low = curves.radius(0, k), high = low;
    for (BeadId b = 0; b < beads_; ++b) {
      to[b] = curves.radius(b, k);
      low = std::min(low, to[b]);
      high = std::max(high, to[b]);
    }
    std::fill_n(to + beads_, padding, to[0]);
    equal_radii_ = equal_radii_ && low == high;
    extent_ = std::max(extent_, high - low);
  }
}

template <int Dimension>
void BeadPaths<Dimension>::find_apart_from_next(std::vector<std::uint8_t>& apart) const {
  apart.resize(beads_ + padding);
  switch (degree_) {
    case 1:
      return find_apart<Dimension, 1>(*this, apart.data());
    case 2:
      return find_apart<Dimension, 2>(*this, apart.data());
    default:
      return find_apart<Dimension, 3>(*this, apart.data());
  }
}

template class BeadPaths<2>;
template class BeadPaths<3>;

}  // namespace kds
