#pragma once
// The positions of beads at one moment, as a motion of degree 0. Over a snapshot, a function of beads has one
// coefficient, its value. Centres and weights are doubles and define the snapshot exactly; there are no
// radii.

#include <Eigen/Core>
#include <span>
#include <vector>

#include "motions/curves/bezier_motion.h"

namespace kds {

template <int DimensionValue>
class Snapshot {
  static_assert(DimensionValue == 2 || DimensionValue == 3);

 public:
  static constexpr int dimension = DimensionValue;
  static constexpr int degree = 0;

  Snapshot() = default;
  /// `centers` has three rows; in the plane the third is ignored.
  Snapshot(const Eigen::Matrix3Xd& centers, std::span<const double> weights) : records_(weights.size()) {
    for (BeadId b = 0; b < records_.size(); ++b) {
      for (int axis = 0; axis < dimension; ++axis) records_[b].control[axis] = centers(axis, b);
      records_[b].control[dimension] = weights[b];
    }
  }

  /// Takes the beads' k-th control points. k = 0 and k = degree are the ends of the motion's step.
  template <Motion M>
  requires(M::dimension == dimension) void set(const M& motion, int k) {
    records_.resize(motion.bead_count());
    for (BeadId b = 0; b < records_.size(); ++b) {
      for (int axis = 0; axis < dimension; ++axis) records_[b].control[axis] = motion.coordinate(b, k, axis);
      records_[b].control[dimension] = motion.weight(b, k);
    }
  }

  [[nodiscard]] std::size_t bead_count() const { return records_.size(); }
  [[nodiscard]] double coordinate(BeadId bead, int, int axis) const { return records_[bead].control[axis]; }
  [[nodiscard]] double weight(BeadId bead, int) const { return records_[bead].control[dimension]; }
  [[nodiscard]] double radius(BeadId, int) const { return 0; }
  [[nodiscard]] const double* radii(BeadId) const { return &no_radius; }
  /// Returns the coordinates, then the weight.
  [[nodiscard]] const double* control_point(BeadId bead, int) const { return records_[bead].control; }

 private:
  struct alignas(DimensionValue == 3 ? 32 : 8) Record {
    double control[DimensionValue + 1] = {};
  };
  static constexpr double no_radius = 0;
  std::vector<Record> records_;
};

static_assert(Motion<Snapshot<2>> && Motion<Snapshot<3>>);

}  // namespace kds
