#pragma once
// A user-defined motion of degree 2: beads move on parabolas about their rest positions.

#include <cstddef>
#include <vector>

#include "motions/curves/motion.h"

namespace extension {

class Swinging {
 public:
  static constexpr int dimension = 3;
  static constexpr int degree = 2;

  explicit Swinging(std::size_t beads) : control_(beads) {}

  [[nodiscard]] std::size_t bead_count() const { return control_.size(); }
  [[nodiscard]] const double* control_point(kds::BeadId bead, int k) const { return control_[bead].point[k]; }
  [[nodiscard]] double coordinate(kds::BeadId bead, int k, int axis) const {
    return control_[bead].point[k][axis];
  }
  [[nodiscard]] double weight(kds::BeadId bead, int k) const { return control_[bead].point[k][3]; }
  [[nodiscard]] const double* radii(kds::BeadId bead) const { return control_[bead].radius; }
  [[nodiscard]] double radius(kds::BeadId bead, int k) const { return control_[bead].radius[k]; }

  /// Makes the bead move from `rest` along `swing` and back.
  void set(kds::BeadId bead, const double (&rest)[3], const double (&swing)[3]) {
    for (int k = 0; k <= degree; ++k)
      for (int axis = 0; axis < dimension; ++axis)
        control_[bead].point[k][axis] = rest[axis] + (k == 1 ? 2 * swing[axis] : 0);
  }

 private:
  struct Curve {
    double point[3][4] = {};
    double radius[3] = {};
  };
  std::vector<Curve> control_;
};

static_assert(kds::Motion<Swinging>);

}  // namespace extension
