#pragma once
// The paths of beads during a step as what scans and bounds of spheres read them: control points in columns.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "motions/curves/bezier_motion.h"
#include "motions/numbers/lanes.h"

namespace kds {

namespace detail {

/// The least and the greatest of each column, in four lanes.
template <std::size_t Columns>
struct ColumnRanges {
  std::array<Lanes, Columns> low, high;
};

/// Columns of beads' coordinates, the k-th control point's one after another: four beads at a time, as long
/// as there are four.
template <Motion M>
[[KDS_LANES_TARGETS]] void copy_columns(const M& motion,
                                        const std::array<double*, (M::degree + 1) * M::dimension>& to,
                                        ColumnRanges<(M::degree + 1) * M::dimension>& ranges) {
  static_assert(M::dimension == 3);
  ranges.low.fill(Lanes(HUGE_VAL));
  ranges.high.fill(Lanes(-HUGE_VAL));
  for (BeadId b = 0; b + Lanes::width <= motion.bead_count(); b += Lanes::width) {
    for (int k = 0; k <= M::degree; ++k) {
      // The weight comes last.
      const auto axes = Lanes::transposed(motion.control_point(b, k), motion.control_point(b + 1, k),
                                          motion.control_point(b + 2, k), motion.control_point(b + 3, k));
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::size_t c = static_cast<std::size_t>(k) * 3 + axis;
        ranges.low[c] = Lanes::min(ranges.low[c], axes[axis]);
        ranges.high[c] = Lanes::max(ranges.high[c], axes[axis]);
        __builtin_memcpy(to[c] + b, &axes[axis].v, sizeof axes[axis].v);
      }
    }
  }
}

}  // namespace detail

/// Control points of all beads' centres and radii during a step, a column each.
template <int Dimension>
class BeadPaths {
 public:
  static constexpr int most_degree = 3;
  static constexpr std::size_t padding = 3;  ///< read four at a time

  /// `left_out`: radii are promised to be equal, and taken to be zero.
  template <bool left_out = false, Motion M>
  void set(const M& motion) {
    static_assert(M::dimension == Dimension && M::degree <= most_degree);
    degree_ = M::degree;
    beads_ = motion.bead_count();
    radii_are_left_out_ = left_out;
    for (std::size_t c = 0; c < columns_of_degree<M::degree>; ++c) columns_[c].resize(beads_ + padding);
    extent_ = 0;
    equal_radii_ = true;
    if (beads_ == 0) return;
    set_coordinates(motion);
    if constexpr (!left_out) set_radii(motion);
  }

  [[nodiscard]] int degree() const { return degree_; }
  [[nodiscard]] std::size_t bead_count() const { return beads_; }
  /// Of all beads for the whole step.
  [[nodiscard]] bool equal_radii() const { return equal_radii_; }
  [[nodiscard]] bool radii_are_left_out() const { return radii_are_left_out_; }
  /// The k-th control points along an axis, or (axis = Dimension) of the radius.
  [[nodiscard]] const double* column(int k, int axis) const { return columns_[place(k, axis)].data(); }
  /// Sets a flag a bead, and some beyond the last: neither it nor the next holds the other at any time of the
  /// step.
  void find_apart_from_next(std::vector<std::uint8_t>& apart) const;
  /// No difference within a column is larger, coordinates or radii.
  [[nodiscard]] double extent() const { return extent_; }

 private:
  template <int degree>
  static constexpr std::size_t columns_of_degree = (degree + 1) * (Dimension + 1);
  static std::size_t place(int k, int axis) { return static_cast<std::size_t>(k * (Dimension + 1) + axis); }

  template <Motion M>
  void set_coordinates(const M& motion) {
    constexpr std::size_t count = (M::degree + 1) * Dimension;
    std::array<double*, count> to;
    for (std::size_t c = 0; c < count; ++c)
      to[c] = columns_[place(static_cast<int>(c / Dimension), static_cast<int>(c % Dimension))].data();
    std::array<double, count> low, high;
    low.fill(HUGE_VAL);
    high.fill(-HUGE_VAL);
    BeadId b = 0;
    if constexpr (Dimension == 3) {
      detail::ColumnRanges<count> ranges;
      detail::copy_columns(motion, to, ranges);
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
        const double x =
            motion.coordinate(b, static_cast<int>(c / Dimension), static_cast<int>(c % Dimension));
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

  template <Motion M>
  void set_radii(const M& motion) {
    for (int k = 0; k <= M::degree; ++k) {
      double* const to = columns_[place(k, Dimension)].data();
      double low = motion.radius(0, k), high = low;
      for (BeadId b = 0; b < beads_; ++b) {
        to[b] = motion.radius(b, k);
        low = std::min(low, to[b]);
        high = std::max(high, to[b]);
      }
      std::fill_n(to + beads_, padding, to[0]);
      equal_radii_ = equal_radii_ && low == high;
      extent_ = std::max(extent_, high - low);
    }
  }

  int degree_ = 1;
  std::size_t beads_ = 0;
  bool equal_radii_ = true, radii_are_left_out_ = false;
  std::array<std::vector<double>, columns_of_degree<most_degree>> columns_;
  double extent_ = 0;
};

}  // namespace kds
