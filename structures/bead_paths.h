#pragma once
// The paths of beads during a step as what scans and bounds of spheres read them: control points in columns.

#include <array>
#include <cstddef>
#include <vector>

#include "motions/bezier_motion.h"

namespace kds {

/// Control points of all beads' centres and radii during a step, a column each.
template <int Dimension>
class BeadPaths {
 public:
  static constexpr int most_degree = 3;
  static constexpr std::size_t padding = 3;  ///< read four at a time

  template <Motion M>
  void set(const M& motion) {
    static_assert(M::dimension == Dimension && M::degree <= most_degree);
    degree_ = M::degree;
    beads_ = motion.bead_count();
    std::array<double*, columns_of_degree<M::degree>> to;
    for (std::size_t c = 0; c < to.size(); ++c) {
      columns_[c].resize(beads_ + padding);
      to[c] = columns_[c].data();
    }
    for (BeadId b = 0; b < beads_; ++b) {
      for (int k = 0; k <= M::degree; ++k) {
        for (int axis = 0; axis < Dimension; ++axis) to[place(k, axis)][b] = motion.coordinate(b, k, axis);
        to[place(k, Dimension)][b] = motion.radius(b, k);
      }
    }
    measure();
  }

  [[nodiscard]] int degree() const { return degree_; }
  [[nodiscard]] std::size_t bead_count() const { return beads_; }
  /// Of all beads for the whole step.
  [[nodiscard]] bool equal_radii() const { return equal_radii_; }
  /// The k-th control points along an axis, or (axis = Dimension) of the radius.
  [[nodiscard]] const double* column(int k, int axis) const { return columns_[place(k, axis)].data(); }
  /// Neither ball holds the other at any time of the step.
  [[nodiscard]] bool are_apart(BeadId a, BeadId b) const;
  /// No difference within a column is larger, coordinates or radii.
  [[nodiscard]] double extent() const { return extent_; }

 private:
  template <int degree>
  static constexpr std::size_t columns_of_degree = (degree + 1) * (Dimension + 1);
  static std::size_t place(int k, int axis) { return static_cast<std::size_t>(k * (Dimension + 1) + axis); }
  void measure();

  int degree_ = 1;
  std::size_t beads_ = 0;
  bool equal_radii_ = true;
  std::array<std::vector<double>, columns_of_degree<most_degree>> columns_;
  double extent_ = 0;
};

}  // namespace kds
