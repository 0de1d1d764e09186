#pragma once
// The balls of a scene at one time, coordinate by coordinate, as the fast loops over consecutive beads want
// them. Behind the last bead there is room that may be read. In the plane there is no third coordinate.

#include <Eigen/Core>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "motions/base/bead.h"
#include "motions/base/input_error.h"
#include "motions/curves/curves.h"

namespace kds {

template <int Dimension>
class Balls {
  static_assert(Dimension == 2 || Dimension == 3);

 public:
  static constexpr std::size_t padding = 8;

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
    for (auto& axis : centers_) axis.resize(radii_.size());
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
        centers_[axis][b] = x;
        not_finite += 0 * x;
      }
    }
    if (not_finite != 0) refuse(centers);
  }

  /// Makes them those of a motion at its k-th control points, in the memory they have. Throws as the
  /// constructor does.
  void move_to(const Curves<Dimension>& curves, int k) {
    const std::size_t beads = curves.bead_count();
    std::uint64_t wrong = 0, changed = radii_.size() == beads + padding ? 0 : 1;
    radii_.resize(beads + padding);
    for (auto& axis : centers_) axis.resize(radii_.size());
    for (BeadId b = 0; b < beads; ++b) {
      const double* const point = curves.control_point(b, k);
      for (std::size_t axis = 0; axis < Dimension; ++axis) {
        centers_[axis][b] = point[axis];
        wrong |= bit_if_not_finite(point[axis]);
      }
      const double radius = curves.radii(b)[k];
      changed |= std::bit_cast<std::uint64_t>(radius) ^ std::bit_cast<std::uint64_t>(radii_[b]);
      radii_[b] = radius;
    }
    for (std::size_t b = 0; b < beads && changed != 0; ++b) {
      equal_radii_ = (b == 0 || equal_radii_) && radii_[b] == radii_[0];
      if (!(radii_[b] >= 0)) wrong |= sign_bit;
      wrong |= bit_if_not_finite(radii_[b]);
    }
    if ((wrong & sign_bit) != 0) refuse();
  }
  /// Whether they are those of a motion at its k-th control points, bit for bit.
  [[nodiscard]] bool are_at(const Curves<Dimension>& curves, int k) const {
    if (size() != curves.bead_count()) return false;
    std::uint64_t other = 0;
    for (BeadId b = 0; b < size(); ++b) {
      const double* const point = curves.control_point(b, k);
      for (std::size_t axis = 0; axis < Dimension; ++axis)
        other |= std::bit_cast<std::uint64_t>(point[axis]) ^ std::bit_cast<std::uint64_t>(centers_[axis][b]);
      other |= std::bit_cast<std::uint64_t>(curves.radii(b)[k]) ^ std::bit_cast<std::uint64_t>(radii_[b]);
    }
    return other == 0;
  }

  /// Puts one ball elsewhere, or another in its place. All finite.
  void place(BeadId bead, const std::array<double, static_cast<std::size_t>(Dimension)>& center,
             double radius) {
    for (std::size_t axis = 0; axis < Dimension; ++axis) centers_[axis][bead] = center[axis];
    equal_radii_ = equal_radii_ && radius == radii_[bead];
    radii_[bead] = radius;
  }

  [[nodiscard]] std::size_t size() const { return radii_.empty() ? 0 : radii_.size() - padding; }
  [[nodiscard]] bool equal_radii() const { return equal_radii_; }
  [[nodiscard]] double radius(BeadId bead) const { return radii_[bead]; }
  [[nodiscard]] double coordinate(BeadId bead, std::size_t axis) const { return centers_[axis][bead]; }
  [[nodiscard]] const double* coordinates(std::size_t axis) const { return centers_[axis].data(); }
  [[nodiscard]] const double* radii() const { return radii_.data(); }

 private:
  [[noreturn]] static void refuse(const Eigen::Matrix3Xd& centers) {
    Eigen::Index b = 0;
    while (centers.col(b).template head<Dimension>().allFinite()) ++b;
    throw InputError("bead " + std::to_string(b) + ": expected finite coordinates");
  }

  static constexpr std::uint64_t sign_bit = std::uint64_t{1} << 63U;
  /// The sign bit is set where x is not finite; others mean nothing. No branch, and no sum to wait for.
  static std::uint64_t bit_if_not_finite(double x) {
    constexpr std::uint64_t exponent = std::uint64_t{0x7ff} << 52U, one = std::uint64_t{1} << 52U;
    return (std::bit_cast<std::uint64_t>(x) & exponent) + one;
  }
  [[noreturn]] void refuse() const {
    for (std::size_t b = 0; b < size(); ++b) {
      for (const auto& axis : centers_)
        if (axis[b] - axis[b] != 0)
          throw InputError("bead " + std::to_string(b) + ": expected finite coordinates");
      if (!(radii_[b] >= 0 && radii_[b] - radii_[b] == 0))
        throw InputError("bead " + std::to_string(b) + ": expected a finite radius, not negative");
    }
    throw InputError("expected finite balls");
  }

  std::array<std::vector<double>, Dimension> centers_;
  std::vector<double> radii_;
  bool equal_radii_ = true;
};

}  // namespace kds
