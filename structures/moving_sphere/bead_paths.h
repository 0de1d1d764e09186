#pragma once
// The paths of beads during a step, stored for scans and for bounds of spheres: control points in columns.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "motions/curves/curves.h"

namespace kds {

/// Control points of all beads' centres and radii during a step, one column per coordinate and control point.
template <int Dimension>
class BeadPaths {
 public:
  static constexpr int most_degree = 3;
  static constexpr std::size_t padding = 3;  ///< columns are read four at a time

  /// Takes curves of degree at most `most_degree`. If radii are promised to be equal, `leave_out_radii`
  /// allows them to be stored as zero.
  void set(const Curves<Dimension>& curves, bool leave_out_radii = false);

  [[nodiscard]] int degree() const { return degree_; }
  [[nodiscard]] std::size_t bead_count() const { return beads_; }
  /// Returns whether all beads have equal radii during the whole step.
  [[nodiscard]] bool equal_radii() const { return equal_radii_; }
  [[nodiscard]] bool radii_are_left_out() const { return radii_are_left_out_; }
  /// Returns the k-th control points along an axis, or of the radius if axis = Dimension.
  [[nodiscard]] const double* column(int k, int axis) const { return columns_[index(k, axis)].data(); }
  /// Sets one flag per bead, and some beyond the last: during the whole step, neither this bead nor the next
  /// one holds the other.
  void find_apart_from_next(std::vector<std::uint8_t>& apart) const;
  /// Returns a bound of all differences within a column, of coordinates or radii.
  [[nodiscard]] double extent() const { return extent_; }

 private:
  static std::size_t index(int k, int axis) { return static_cast<std::size_t>(k * (Dimension + 1) + axis); }

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
