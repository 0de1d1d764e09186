#pragma once
// The balls of a scene at one time as a structure of arrays, coordinate by coordinate, for the fast loops
// over consecutive beads. Memory beyond the last bead is readable. In the plane the third coordinate is
// absent.

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "motions/base/bead.h"
#include "motions/base/input_error.h"
#include "motions/curves/curves.h"
#include "structures/necklace/ball_rows.h"

namespace kds {

template <int Dimension>
class Balls : public BallRows<Dimension> {
 public:
  using BallRows<Dimension>::padding;
  using BallRows<Dimension>::size;

  Balls() = default;
  /// Constructs balls from centres, one column per bead. The plane ignores a third coordinate. Throws
  /// InputError naming the bead if a coordinate or radius is not finite, or if a radius is negative.
  Balls(const Eigen::Matrix3Xd& centers, std::span<const double> radii) : radii_(radii.begin(), radii.end()) {
    if (static_cast<std::size_t>(centers.cols()) != radii.size())
      throw InputError("expected one radius a bead: " + std::to_string(centers.cols()) + " beads, " +
                       std::to_string(radii.size()) + " radii");
    for (std::size_t b = 0; b < radii.size(); ++b) {
      if (!(radii[b] >= 0 && radii[b] - radii[b] == 0))
        throw InputError("bead " + std::to_string(b) + ": expected a finite radius, not negative");
      equal_radii_ = equal_radii_ && radii[b] == radii[0];
    }
    radii_.resize(radii.size() + padding);
    rows_.resize(radii_.size());
    for (auto& axis : centers_) axis.resize(radii_.size());
    for (std::size_t b = 0; b < radii.size(); ++b) rows_[b].radius = radii_[b];
    move_to(centers);
  }

  /// Constructs the balls of a motion at its k-th control points. Throws like the constructor from centres.
  Balls(const Curves<Dimension>& curves, int k) { move_to(curves, k); }

  /// Moves the same balls to other centres. Throws like the constructor.
  void move_to(const Eigen::Matrix3Xd& centers) {
    if (static_cast<std::size_t>(centers.cols()) != size())
      throw InputError("expected " + std::to_string(size()) + " beads, not " +
                       std::to_string(centers.cols()));
    double not_finite = 0;  // zero times infinity or NaN is NaN
    for (std::size_t b = 0; b < size(); ++b) {
      for (std::size_t axis = 0; axis < Dimension; ++axis) {
        const double x = centers(static_cast<Eigen::Index>(axis), static_cast<Eigen::Index>(b));
        centers_[axis][b] = rows_[b].center[axis] = x;
        not_finite += 0 * x;
      }
    }
    if (not_finite != 0) refuse(centers);
  }

  /// Moves the balls to the k-th control points of a motion and reuses their memory. Throws like the
  /// constructor.
  void move_to(const Curves<Dimension>& curves, int k) { (void)copy(curves, k, nullptr); }
  /// Like BallRows::move_on_from.
  [[nodiscard]] bool move_on_from(const Balls& start, const Curves<Dimension>& curves) {
    return copy(curves, 1, &start);
  }

  /// Gives one ball another centre and radius. All arguments are finite.
  void place(BeadId bead, const std::array<double, static_cast<std::size_t>(Dimension)>& center,
             double radius) {
    for (std::size_t axis = 0; axis < Dimension; ++axis) centers_[axis][bead] = center[axis];
    equal_radii_ = equal_radii_ && radius == radii_[bead];
    radii_[bead] = radius;
    rows_[bead] = {center, radius};
  }

  [[nodiscard]] double radius(BeadId bead) const { return radii_[bead]; }
  [[nodiscard]] double coordinate(BeadId bead, std::size_t axis) const { return centers_[axis][bead]; }
  [[nodiscard]] const double* coordinates(std::size_t axis) const { return centers_[axis].data(); }
  [[nodiscard]] const double* radii() const { return radii_.data(); }

 private:
  using BallRows<Dimension>::rows_;
  using BallRows<Dimension>::equal_radii_;

  bool copy(const Curves<Dimension>& curves, int k, const Balls* start);  // is `start` right?
  [[noreturn]] static void refuse(const Eigen::Matrix3Xd& centers) {
    Eigen::Index b = 0;
    while (centers.col(b).template head<Dimension>().allFinite()) ++b;
    throw InputError("bead " + std::to_string(b) + ": expected finite coordinates");
  }

  std::array<std::vector<double>, Dimension> centers_;
  std::vector<double> radii_;
};

}  // namespace kds
