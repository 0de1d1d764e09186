#pragma once
// The balls of a scene at one time, one by one, and coordinate by coordinate, as the fast loops over
// consecutive beads want them. Behind the last bead there is room that may be read. In the plane there is no
// third coordinate.

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
  /// One column a bead; a third coordinate is left out in the plane. Throws InputError naming the bead whose
  /// coordinates or radius are not finite, or its radius negative.
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

  /// Those of a motion at its k-th control points. Throws as the other.
  Balls(const Curves<Dimension>& curves, int k) { move_to(curves, k); }

  /// Puts the same balls elsewhere. Throws as the constructor does.
  void move_to(const Eigen::Matrix3Xd& centers) {
    if (static_cast<std::size_t>(centers.cols()) != size())
      throw InputError("expected " + std::to_string(size()) + " beads, not " +
                       std::to_string(centers.cols()));
    double not_finite = 0;  // zero times what is not finite is NaN
    for (std::size_t b = 0; b < size(); ++b) {
      for (std::size_t axis = 0; axis < Dimension; ++axis) {
        const double x = centers(static_cast<Eigen::Index>(axis), static_cast<Eigen::Index>(b));
        centers_[axis][b] = rows_[b].center[axis] = x;
        not_finite += 0 * x;
      }
    }
    if (not_finite != 0) refuse(centers);
  }

  /// Makes them those of a motion at its k-th control points, in the memory they have. Throws as the
  /// constructor does.
  void move_to(const Curves<Dimension>& curves, int k) { (void)copy(curves, k, nullptr); }
  /// As that of rows.
  [[nodiscard]] bool move_on_from(const Balls& start, const Curves<Dimension>& curves) {
    return copy(curves, 1, &start);
  }

  /// Puts one ball elsewhere, or another in its place. All finite.
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

  bool copy(const Curves<Dimension>& curves, int k, const Balls* start);  ///< whether `start` is known
  [[noreturn]] static void refuse(const Eigen::Matrix3Xd& centers) {
    Eigen::Index b = 0;
    while (centers.col(b).template head<Dimension>().allFinite()) ++b;
    throw InputError("bead " + std::to_string(b) + ": expected finite coordinates");
  }

  std::array<std::vector<double>, Dimension> centers_;
  std::vector<double> radii_;
};

}  // namespace kds
