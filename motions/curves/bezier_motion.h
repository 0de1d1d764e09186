#pragma once
// A motion (motion.h) whose degree is a compile-time constant. The certificates' filters are compiled for
// such degrees.

#include <cstddef>
#include <limits>
#include <vector>

#include "motions/base/finite.h"
#include "motions/curves/linear_ends.h"
#include "motions/curves/motion.h"

namespace kds {

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
  /// Sets the motion of all beads from one frame to the next (linear_ends.h). Throws like finite(); the
  /// control points are undefined then.
  void set_ends(const double* start, const double* end, const double* radii) requires(degree == 1) {
    static_assert(sizeof(Record) == 2 * (dimension + 1) * sizeof(double));
    if (records_.empty()) return;
    if (!set_linear_ends<dimension>(start, end, radii, records_.size(), records_[0].control[0],
                                    radii_[0].control))
      (void)finite(std::numeric_limits<double>::infinity());
  }
  [[nodiscard]] double radius(BeadId bead, int k) const { return radii_[bead].control[k]; }
  [[nodiscard]] const double* radii(BeadId bead) const { return radii_[bead].control; }
  void set_radius(BeadId bead, int k, double value) { radii_[bead].control[k] = finite(value); }

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
};

static_assert(Motion<BezierMotion<3, 1>>);

}  // namespace kds
