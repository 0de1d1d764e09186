#pragma once
// The balls of a scene at one time, for fast loops over beads, as an array of structures (BallRows) and also
// as a structure of arrays (Balls). Memory beyond the last bead is readable.

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "motions/base/bead.h"
#include "motions/base/input_error.h"
#include "motions/curves/curves.h"

namespace kds {

/// A sphere in rounded numbers, for output. In the plane it is a circle whose third coordinate is 0.
struct Sphere {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double radius = 0;
};

/// A node of a hierarchy with its sphere, for output.
struct NodeSphere {
  BeadRange range;
  Sphere sphere;
};

/// A centre and a radius in a row of four doubles, the layout that vector loads take. In the plane the fourth
/// double is unused.
template <int Dimension>
struct alignas(32) BallRow {
  std::array<double, static_cast<std::size_t>(Dimension)> center{};
  double radius = 0;
};

/// Balls as an array of structures.
template <int Dimension>
class BallRows {
  static_assert(Dimension == 2 || Dimension == 3);

 public:
  /// Number of rows that are readable beyond the last ball.
  static constexpr std::size_t padding = 8;

  BallRows() = default;
  /// Constructs the balls of a motion at its k-th control points. Throws InputError naming the bead if a
  /// coordinate or radius is not finite, or if a radius is negative.
  BallRows(const Curves<Dimension>& curves, int k) { (void)move_to(curves, k); }

  /// Moves the balls to the k-th control points of a motion and reuses their memory. Returns whether any
  /// radius, or the number of radii, differs from before. If the function throws, the object then holds no
  /// balls.
  bool move_to(const Curves<Dimension>& curves, int k) { return copy(curves, k, nullptr).others_radii; }
  /// Moves the balls to the first control points after the start. Returns whether `start` equals the balls at
  /// the start, bit for bit. The comparison takes place in the same pass.
  [[nodiscard]] bool move_on_from(const BallRows& start, const Curves<Dimension>& curves) {
    return copy(curves, 1, &start).start_is_known;
  }

  [[nodiscard]] std::size_t size() const { return rows_.empty() ? 0 : rows_.size() - padding; }
  [[nodiscard]] bool equal_radii() const { return equal_radii_; }
  /// Returns true if all radii are known to equal `radius`, else false.
  [[nodiscard]] bool all_have(double radius) const {
    return equal_radii_ && size() > 0 && rows_[0].radius == radius;
  }
  [[nodiscard]] const BallRow<Dimension>* rows() const { return rows_.data(); }

 protected:
  struct Copied {
    bool others_radii, start_is_known;
  };
  Copied copy(const Curves<Dimension>& curves, int k, const BallRows* start);

  std::vector<BallRow<Dimension>> rows_;
  bool equal_radii_ = true;
};

/// Balls also as a structure of arrays, coordinate by coordinate, for loops over consecutive beads. In the
/// plane the third coordinate is absent.
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
