#pragma once
// The paths of beads during a step as what scans and bounds of spheres read them: control points in columns.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "motions/curves/curves.h"

namespace kds {

/// Control points of all beads' centres and radii during a step, a column each.
template <int Dimension>
class BeadPaths {
 public:
  static constexpr int most_degree = 3;
  static constexpr std::size_t padding = 3;  ///< read four at a time

  /// Of degree at most `most_degree`. Radii may be left out where they are promised to be equal: they are
  /// taken to be zero.
  void set(const Curves<Dimension>& curves, bool leave_out_radii = false);

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
  static std::size_t place(int k, int axis) { return static_cast<std::size_t>(k * (Dimension + 1) + axis); }

  template <int K>
  void set_coordinates(const FixedCurves<Dimension, K>& curves);
  void set_radii(const Curves<Dimension>& curves);

  int degree_ = 1;
  std::size_t beads_ = 0;
  bool equal_radii_ = true, radii_are_left_out_ = false;
  std::array<std::vector<double>, (most_degree + 1) * (Dimension + 1)> columns_;
  double extent_ = 0;
};

}  // namespace kds
