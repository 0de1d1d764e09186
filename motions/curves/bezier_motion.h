#pragma once
// Motions (motion.h) that store the control points of their beads: BezierMotion, whose degree is a
// compile-time constant, and AnyDegreeMotion, whose degree is known only at run time.

#include <Eigen/Core>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "motions/base/floating_point_scope.h"
#include "motions/curves/motion.h"
#include "motions/numbers/bernstein.h"

namespace kds {

/// The cell of a motion's step (HasCell); empty if there is none.
template <int Dimension>
class CellOfStep {
 public:
  /// Sets the cell of a motion of this degree from one frame to the next; the first `Dimension` columns and
  /// rows of the matrices are used. Control points at the ends are those of the frames. Those between are
  /// rounded once, so the vectors of a motion of degree 1 move linearly, and others do so up to rounding.
  void set(const Eigen::Matrix3d& start, const Eigen::Matrix3d& end, int degree) {
    points_.clear();
    for (int vector = 0; vector < Dimension; ++vector)
      for (int k = 0; k <= degree; ++k)
        for (int axis = 0; axis < Dimension; ++axis)
          points_.push_back(finite(point(start(axis, vector), end(axis, vector), k, degree)));
  }
  void clear() { points_.clear(); }
  [[nodiscard]] const double* data() const { return points_.empty() ? nullptr : points_.data(); }

 private:
  [[nodiscard]] static double point(double start, double end, int k, int degree) {
    if (k == 0 || start == end) return start;
    if (k == degree) return end;
    return start + (end - start) * (static_cast<double>(k) / degree);
  }

  std::vector<double> points_;
};

namespace detail {

/// Sets both control points of linear motion for all beads at once. This conversion from frames to motion is
/// a considerable part of a step. Frames have three numbers per bead, of which the first `dimension` are
/// used. Radii are one per bead and constant; weights are their squares. For each bead, `points` receives two
/// control points of coordinates and weight, and `own_radii` receives the radius of both. Returns whether all
/// numbers are finite.
template <int Dimension>
[[nodiscard]] bool set_linear_ends(const double* start, const double* end, const double* radii,
                                   std::size_t beads, double* points, double* own_radii);

}  // namespace detail

/// A motion of constant degree. The filters of certificates are compiled for such degrees.
template <int DimensionValue, int DegreeValue>
class BezierMotion {
  static_assert(DimensionValue >= 1 && DimensionValue <= 3 && DegreeValue >= 1);

 public:
  static constexpr int dimension = DimensionValue;
  static constexpr int degree = DegreeValue;

  explicit BezierMotion(std::size_t beads) : records_(beads), radii_(beads) {}

  [[nodiscard]] std::size_t bead_count() const { return records_.size(); }
  [[nodiscard]] double coordinate(BeadId bead, int k, int axis) const {
    return records_[bead].control[k][axis];
  }
  [[nodiscard]] double weight(BeadId bead, int k) const { return records_[bead].control[k][dimension]; }
  /// Returns the k-th control point: dimension + 1 numbers in a row, the weight last.
  [[nodiscard]] const double* control_point(BeadId bead, int k) const { return records_[bead].control[k]; }
  void set_coordinate(BeadId bead, int k, int axis, double value) {
    records_[bead].control[k][axis] = finite(value);
  }
  void set_weight(BeadId bead, int k, double value) { records_[bead].control[k][dimension] = finite(value); }
  /// Sets the motion of all beads from one frame to the next (detail::set_linear_ends). Throws like finite();
  /// the control points are undefined then.
  void set_ends(const double* start, const double* end, const double* radii) requires(degree == 1) {
    static_assert(sizeof(Record) == 2 * (dimension + 1) * sizeof(double));
    if (records_.empty()) return;
    if (!detail::set_linear_ends<dimension>(start, end, radii, records_.size(), records_[0].control[0],
                                            radii_[0].control))
      (void)finite(std::numeric_limits<double>::infinity());
  }
  [[nodiscard]] double radius(BeadId bead, int k) const { return radii_[bead].control[k]; }
  [[nodiscard]] const double* radii(BeadId bead) const { return radii_[bead].control; }
  void set_radius(BeadId bead, int k, double value) { radii_[bead].control[k] = finite(value); }
  [[nodiscard]] const double* cell() const { return cell_.data(); }
  /// Sets the cell of the step, which stays until another is set.
  [[nodiscard]] CellOfStep<dimension>& own_cell() { return cell_; }

 private:
  // Stores the control points of a bead together. For linear motion in space they fill one cache line.
  struct alignas(DimensionValue == 3 && DegreeValue == 1 ? 64 : 8) Record {
    double control[degree + 1][dimension + 1] = {};
  };
  std::vector<Record> records_;
  // Stores radii in a separate array, since few certificates use them.
  struct Radius {
    double control[degree + 1] = {};
  };
  std::vector<Radius> radii_;
  CellOfStep<dimension> cell_;
};

static_assert(Motion<BezierMotion<3, 1>>);

/// A motion whose degree is known only at run time, for users' polynomials of degrees for which no filters
/// are compiled. Control points are kept as given.
template <int DimensionValue>
class AnyDegreeMotion {
  static_assert(DimensionValue >= 1 && DimensionValue <= 3);

 public:
  static constexpr int dimension = DimensionValue;
  static constexpr int degree = any_degree;

  /// Throws std::invalid_argument if the degree is negative.
  AnyDegreeMotion(std::size_t beads, int own_degree)
      : own_degree_(accepted(own_degree)),
        beads_(beads),
        control_(beads * row() * (dimension + 1)),
        radii_(beads * row()) {}

  [[nodiscard]] int own_degree() const { return own_degree_; }
  [[nodiscard]] std::size_t bead_count() const { return beads_; }
  [[nodiscard]] const double* control_point(BeadId bead, int k) const {
    return &control_[(bead * row() + static_cast<std::size_t>(k)) * (dimension + 1)];
  }
  [[nodiscard]] double coordinate(BeadId bead, int k, int axis) const { return control_point(bead, k)[axis]; }
  [[nodiscard]] double weight(BeadId bead, int k) const { return control_point(bead, k)[dimension]; }
  [[nodiscard]] const double* radii(BeadId bead) const { return &radii_[bead * row()]; }
  [[nodiscard]] double radius(BeadId bead, int k) const { return radii(bead)[k]; }
  void set_coordinate(BeadId bead, int k, int axis, double value) { number(bead, k, axis) = finite(value); }
  void set_weight(BeadId bead, int k, double value) { number(bead, k, dimension) = finite(value); }
  void set_radius(BeadId bead, int k, double value) {
    radii_[bead * row() + static_cast<std::size_t>(k)] = finite(value);
  }
  [[nodiscard]] const double* cell() const { return cell_.data(); }
  /// Sets the cell of the step, which stays until another is set.
  [[nodiscard]] CellOfStep<dimension>& own_cell() { return cell_; }

 private:
  [[nodiscard]] static int accepted(int wanted) {
    if (wanted < 0)
      throw std::invalid_argument("a motion of degree " + std::to_string(wanted) + ": expected 0 or more");
    return wanted;
  }
  [[nodiscard]] std::size_t row() const { return static_cast<std::size_t>(own_degree_) + 1; }
  [[nodiscard]] double& number(BeadId bead, int k, int column) {
    return control_[(bead * row() + static_cast<std::size_t>(k)) * (dimension + 1) +
                    static_cast<std::size_t>(column)];
  }

  int own_degree_;
  std::size_t beads_;
  std::vector<double> control_, radii_;
  CellOfStep<dimension> cell_;
};

static_assert(Motion<AnyDegreeMotion<3>>);

}  // namespace kds
