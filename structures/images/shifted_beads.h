#pragma once
// Images of beads in a periodic cell, for exact certificates. An image of a bead is the bead moved by a
// shift, a whole multiple of the cell's vectors, which change with time as the cell does.
//
// A shift is rarely a double, so its control points are stored as the difference of two points, which
// `image_contact` certificates name like beads. Such a certificate is exact for the rounded vectors, also if
// the cell changes, and its function has the degree of the motion's squares.
//
// The vectors' control points are rounded once: to multiples of 2^-80 of the largest coordinate among the
// vectors at the same control point, so the vectors of a frame are the same in both steps that it joins. Any
// coordinate above 2^-27 of the largest one is such a multiple already.

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "motions/base/input_error.h"
#include "motions/curves/curves.h"
#include "motions/curves/motion.h"
#include "motions/frames/periodic.h"

namespace kds {

/// A whole multiple of each vector of the cell.
template <int Dimension>
using CellShift = std::array<std::int32_t, static_cast<std::size_t>(Dimension)>;

/// Returns a + sign * b.
template <std::size_t N>
[[nodiscard]] std::array<std::int32_t, N> plus(std::array<std::int32_t, N> a,
                                               const std::array<std::int32_t, N>& b, int sign = 1) {
  for (std::size_t i = 0; i < N; ++i) a[i] += sign * b[i];
  return a;
}
template <std::size_t N>
[[nodiscard]] bool is_zero(const std::array<std::int32_t, N>& shift) {
  return std::all_of(shift.begin(), shift.end(), [](std::int32_t i) { return i == 0; });
}
/// Returns a shift as a vector, rounded. The columns of `cell` are the vectors.
template <std::size_t N>
[[nodiscard]] Eigen::Vector3d vector_of(const std::array<std::int32_t, N>& shift,
                                        const Eigen::Matrix3d& cell) {
  Eigen::Vector3d vector = Eigen::Vector3d::Zero();
  for (std::size_t a = 0; a < N; ++a) vector += cell.col(static_cast<Eigen::Index>(a)) * shift[a];
  return vector;
}

/// Returns a coordinate of a shift at control point k of the curves' cell, rounded.
template <int D>
[[nodiscard]] double shift_coordinate(const Curves<D>& curves, const CellShift<D>& shift, int k, int axis) {
  double sum = 0;
  for (int vector = 0; vector < D; ++vector)
    sum += shift[static_cast<std::size_t>(vector)] * curves.cell_coordinate(vector, k, axis);
  return sum;
}
/// Returns a bound of the terms of shift_coordinate, for margins of rounding.
template <int D>
[[nodiscard]] double size_of_shift(const Curves<D>& curves, const CellShift<D>& shift, int k, int axis) {
  double sum = 0;
  for (int vector = 0; vector < D; ++vector)
    sum += std::abs(shift[static_cast<std::size_t>(vector)] * curves.cell_coordinate(vector, k, axis));
  return sum;
}
/// Returns the cell of the curves at control point k.
template <int D>
[[nodiscard]] Cell cell_of(const Curves<D>& curves, int k) {
  Cell cell = Cell::Zero();
  for (int vector = 0; vector < D; ++vector)
    for (int axis = 0; axis < D; ++axis) cell(axis, vector) = curves.cell_coordinate(vector, k, axis);
  return cell;
}

/// Numbers shifts in the order in which they are first asked for. Shift 0 is none.
template <int Dimension>
class ShiftNumbers {
 public:
  ShiftNumbers() { (void)number_of({}); }

  /// The largest multiple of a cell vector.
  static constexpr std::int32_t most = 1 << 20;

  /// Throws InputError if a multiple is too large.
  [[nodiscard]] std::uint32_t number_of(const CellShift<Dimension>& shift) {
    for (const std::int32_t multiple : shift)
      if (std::abs(multiple) > most)
        throw InputError("two beads are more than a million cells apart; expected fewer");
    const auto [found, is_new] = numbers_.try_emplace(shift, static_cast<std::uint32_t>(shifts_.size()));
    if (is_new) shifts_.push_back(shift);
    return found->second;
  }
  [[nodiscard]] std::optional<std::uint32_t> find(const CellShift<Dimension>& shift) const {
    const auto found = numbers_.find(shift);
    return found == numbers_.end() ? std::nullopt : std::optional(found->second);
  }
  [[nodiscard]] const CellShift<Dimension>& shift(std::uint32_t number) const { return shifts_[number]; }
  [[nodiscard]] std::size_t size() const { return shifts_.size(); }

 private:
  std::map<CellShift<Dimension>, std::uint32_t> numbers_;
  std::vector<CellShift<Dimension>> shifts_;
};

/// A motion of the beads of another motion and of two points for each shift, with radii 0.
template <int Dimension>
class ShiftedBeads {
 public:
  static constexpr int dimension = Dimension;
  static constexpr int degree = any_degree;
  explicit ShiftedBeads(int own_degree) : row_(static_cast<std::size_t>(own_degree) + 1) {}

  /// Copies the beads of the step and computes the shifts. Without a cell there are none but 0.
  void set(const Curves<Dimension>& curves, const ShiftNumbers<Dimension>& shifts) {
    beads_ = curves.bead_count();
    points_.resize((beads_ + 2 * shifts.size()) * row_ * stride);
    radii_.assign((beads_ + 2 * shifts.size()) * row_, 0);
    for (BeadId bead = 0; bead < beads_; ++bead) copy(curves, bead);
    for (std::size_t k = 0; k < row_; ++k) set_shifts(curves, shifts, k);
  }
  /// Does the same after only these beads have changed since the last call in the same step.
  void set_of(const Curves<Dimension>& curves, std::span<const BeadId> beads,
              const ShiftNumbers<Dimension>& shifts) {
    if (radii_.size() != (curves.bead_count() + 2 * shifts.size()) * row_) return set(curves, shifts);
    for (const BeadId bead : beads) copy(curves, bead);
  }
  /// Returns the points whose difference is the shift of this number.
  [[nodiscard]] BeadId to(std::uint32_t number) const { return static_cast<BeadId>(beads_ + 2 * number); }
  [[nodiscard]] BeadId from(std::uint32_t number) const { return to(number) + 1; }

  [[nodiscard]] int own_degree() const { return static_cast<int>(row_) - 1; }
  [[nodiscard]] std::size_t bead_count() const { return radii_.size() / row_; }
  [[nodiscard]] const double* control_point(BeadId bead, int k) const {
    return &points_[(bead * row_ + static_cast<std::size_t>(k)) * stride];
  }
  [[nodiscard]] double coordinate(BeadId bead, int k, int axis) const { return control_point(bead, k)[axis]; }
  [[nodiscard]] double weight(BeadId bead, int k) const { return control_point(bead, k)[dimension]; }
  [[nodiscard]] const double* radii(BeadId bead) const { return &radii_[bead * row_]; }
  [[nodiscard]] double radius(BeadId bead, int k) const { return radii(bead)[k]; }

 private:
  static constexpr std::size_t stride = Dimension + 1;
  __extension__ using Integer = __int128;

  void copy(const Curves<Dimension>& curves, BeadId bead) {
    std::copy_n(curves.control_point(bead, 0), row_ * stride, &points_[bead * row_ * stride]);
    std::copy_n(curves.radii(bead), row_, &radii_[bead * row_]);
  }

  void set_shifts(const Curves<Dimension>& curves, const ShiftNumbers<Dimension>& shifts, std::size_t k) {
    double largest = 0;
    const auto cell_coordinate = [&](int vector, int axis) {
      return curves.cell() == nullptr ? 0 : curves.cell_coordinate(vector, static_cast<int>(k), axis);
    };
    for (int vector = 0; vector < Dimension; ++vector)
      for (int axis = 0; axis < Dimension; ++axis)
        largest = std::max(largest, std::abs(cell_coordinate(vector, axis)));
    const int unit = largest > 0 ? std::ilogb(largest) + 1 - 80 : 0;  // a power of two
    Integer cell[Dimension][Dimension];                               // in units, below 2^80
    for (int vector = 0; vector < Dimension; ++vector)
      for (int axis = 0; axis < Dimension; ++axis)
        cell[vector][axis] =
            static_cast<Integer>(std::nearbyint(std::ldexp(cell_coordinate(vector, axis), -unit)));
    for (std::uint32_t number = 0; number < shifts.size(); ++number) {
      const CellShift<Dimension>& shift = shifts.shift(number);
      double* const high = &points_[(to(number) * row_ + k) * stride];
      double* const low = &points_[(from(number) * row_ + k) * stride];
      for (int axis = 0; axis < Dimension; ++axis) {
        Integer sum = 0;  // below 2^102
        for (int vector = 0; vector < Dimension; ++vector)
          sum += cell[vector][axis] * shift[static_cast<std::size_t>(vector)];
        const auto rounded = static_cast<double>(sum);
        const auto rest = static_cast<double>(sum - static_cast<Integer>(rounded));  // exact
        high[axis] = std::ldexp(rounded, unit);
        low[axis] = -std::ldexp(rest, unit);
      }
      high[Dimension] = low[Dimension] = 0;
    }
  }

  std::size_t row_;  // control points per bead
  std::size_t beads_ = 0;
  std::vector<double> points_, radii_;
};

static_assert(Motion<ShiftedBeads<3>>);

}  // namespace kds
