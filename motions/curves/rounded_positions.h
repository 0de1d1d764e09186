#pragma once
// Positions of the beads at one time of a step, in doubles with error bounds (ball arithmetic), computed from
// the control points. They decide nearly every sign that an audit needs; integers decide the others.

#include <array>
#include <cstddef>
#include <vector>

#include "motions/curves/motion_ref.h"
#include "motions/numbers/exact_number.h"
#include "motions/numbers/tracked_double.h"

namespace kds {

template <int Dimension>
class RoundedPositions {
 public:
  /// The coordinates, then the weight, padded to four numbers.
  using Row = std::array<double, 4>;

  /// Rounding must be to nearest.
  RoundedPositions(const MotionRef<Dimension>& motion, const Dyadic& time);

  [[nodiscard]] std::size_t size() const { return rows_.size(); }
  [[nodiscard]] const Row& row(BeadId bead) const { return rows_[bead]; }
  /// Return bounds on the error of every coordinate and of every weight. They are infinite if a number
  /// overflows.
  [[nodiscard]] double coordinate_error() const { return coordinate_error_; }
  [[nodiscard]] double weight_error() const { return weight_error_; }

  [[nodiscard]] TrackedDouble coordinate(BeadId bead, std::size_t axis) const {
    return {rows_[bead][axis], coordinate_error_};
  }
  [[nodiscard]] TrackedDouble radius(BeadId bead) const { return radii_[bead]; }

 private:
  std::vector<Row> rows_;
  std::vector<TrackedDouble> radii_;
  double coordinate_error_ = 0, weight_error_ = 0;
};

extern template class RoundedPositions<2>;
extern template class RoundedPositions<3>;

}  // namespace kds
