#pragma once
// Copies of the curves of a few beads, numbered from 0, which remain valid after the motion's step.

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "motions/curves/curves.h"

namespace kds {

/// `C`: Curves or LiftedCurves.
template <class C>
class CopiedCurves {
 public:
  template <Motion M>
  CopiedCurves(const M& motion, std::span<const BeadId> beads)
      : degree_(degree_of(motion)), count_(beads.size()) {
    numbers_.reserve(points() * (C::dimension + 2) + C::dimension + 1);
    for (const BeadId bead : beads) {
      for (int k = 0; k <= degree_; ++k) {
        for (int axis = 0; axis < C::dimension; ++axis) numbers_.push_back(motion.coordinate(bead, k, axis));
        numbers_.push_back(motion.weight(bead, k));
      }
    }
    for (const BeadId bead : beads)
      for (int k = 0; k <= degree_; ++k) numbers_.push_back(motion.radius(bead, k));
    if constexpr (lifted<C>)
      for (int axis = 0; axis < C::dimension; ++axis) numbers_.push_back(motion.drift(axis));
    numbers_.push_back(degree_);
  }

  /// Returns all numbers that define the curves.
  [[nodiscard]] const std::vector<double>& numbers() const { return numbers_; }
  /// Returns the curves. They are valid during the life of this object.
  [[nodiscard]] C curves() const {
    const Curves<C::dimension> curves(Points{*this});
    if constexpr (lifted<C>) {
      typename C::Vector drift{};
      const double* from = radii(0) + points();
      for (std::size_t axis = 0; axis < drift.size(); ++axis) drift[axis] = from[axis];
      return C(curves, drift);
    } else {
      return curves;
    }
  }

 private:
  /// The layout that Curves expect.
  struct Points {
    static constexpr int dimension = C::dimension;
    static constexpr int degree = any_degree;
    const CopiedCurves& of;

    [[nodiscard]] int own_degree() const { return of.degree_; }
    [[nodiscard]] std::size_t bead_count() const { return of.count_; }
    [[nodiscard]] const double* control_point(BeadId bead, int k) const { return of.control_point(bead, k); }
    [[nodiscard]] double coordinate(BeadId bead, int k, int axis) const {
      return of.control_point(bead, k)[axis];
    }
    [[nodiscard]] double weight(BeadId bead, int k) const { return of.control_point(bead, k)[dimension]; }
    [[nodiscard]] const double* radii(BeadId bead) const { return of.radii(bead); }
    [[nodiscard]] double radius(BeadId bead, int k) const { return of.radii(bead)[k]; }
  };

  [[nodiscard]] std::size_t per_bead() const { return static_cast<std::size_t>(degree_) + 1; }
  [[nodiscard]] std::size_t points() const { return count_ * per_bead(); }
  [[nodiscard]] const double* control_point(BeadId bead, int k) const {
    return numbers_.data() + (bead * per_bead() + static_cast<std::size_t>(k)) * (C::dimension + 1);
  }
  [[nodiscard]] const double* radii(BeadId bead) const {
    return numbers_.data() + points() * (C::dimension + 1) + bead * per_bead();
  }

  int degree_;
  std::size_t count_;
  std::vector<double> numbers_;
};

}  // namespace kds
