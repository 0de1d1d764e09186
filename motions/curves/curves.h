#pragma once
// Views of the control points of a motion of any type, as structures and searches use them. Nothing is
// rounded, and all but CopiedCurves hold pointers, which stay valid until the motion allocates memory for
// other beads.
//
//   Curves           degree known at run time
//   FixedCurves      constant degree: used by code compiled for vectors of beads
//   LiftedCurves     a lifted motion (lifted_motion.h), whose degree is 1
//   CopiedCurves     copies of a few beads' control points, which outlive the motion's step

#include <array>
#include <cstddef>
#include <span>
#include <stdexcept>
#include <type_traits>
#include <vector>

#include "motions/base/bead.h"
#include "motions/curves/motion.h"
#include "motions/numbers/bernstein.h"

namespace kds {

template <int DimensionValue>
class Curves {
 public:
  static constexpr int dimension = DimensionValue;
  static constexpr int degree = any_degree;

  Curves() = default;
  /// Throws std::invalid_argument if the control points are not laid out as the concept requires.
  template <Motion M>
  requires(M::dimension == DimensionValue) explicit Curves(const M& motion)
      : degree_(degree_of(motion)), beads_(motion.bead_count()) {
    if (beads_ == 0) return;
    points_ = motion.control_point(0, 0);
    radii_ = motion.radii(0);
    if constexpr (HasCell<M>) cell_ = motion.cell();
    if (beads_ > 1) {
      stride_ = motion.control_point(1, 0) - points_;
      radii_stride_ = motion.radii(1) - radii_;
    }
    const auto last = static_cast<BeadId>(beads_ - 1);
    for (const BeadId bead : {BeadId{0}, last}) {
      if (motion.control_point(bead, degree_) != motion.control_point(bead, 0) + (dimension + 1) * degree_)
        throw std::invalid_argument("control points of a bead do not lie in a row");
    }
    if (motion.control_point(last, 0) != control_point(last, 0))
      throw std::invalid_argument("control points do not lie equally spaced from bead to bead");
    if (motion.radii(last) != radii(last))
      throw std::invalid_argument("radii do not lie equally spaced from bead to bead");
  }

  /// Returns the beads at the end of the step, as curves of degree 0 without a cell.
  [[nodiscard]] Curves at_end() const {
    Curves end = *this;
    end.cell_ = nullptr;
    if (beads_ > 0) end.points_ += (dimension + 1) * degree_;
    if (beads_ > 0) end.radii_ += degree_;
    end.degree_ = 0;
    return end;
  }

  [[nodiscard]] int own_degree() const { return degree_; }
  [[nodiscard]] std::size_t bead_count() const { return beads_; }
  [[nodiscard, gnu::always_inline]] const double* control_point(BeadId bead, int k) const {
    return points_ + stride_ * static_cast<std::ptrdiff_t>(bead) + (dimension + 1) * k;
  }
  [[nodiscard, gnu::always_inline]] double coordinate(BeadId bead, int k, int axis) const {
    return control_point(bead, k)[axis];
  }
  [[nodiscard, gnu::always_inline]] double weight(BeadId bead, int k) const {
    return control_point(bead, k)[dimension];
  }
  [[nodiscard, gnu::always_inline]] const double* radii(BeadId bead) const {
    return radii_ + radii_stride_ * static_cast<std::ptrdiff_t>(bead);
  }
  [[nodiscard, gnu::always_inline]] double radius(BeadId bead, int k) const { return radii(bead)[k]; }

  /// Returns the cell of the step (HasCell), or null if there is none.
  [[nodiscard]] const double* cell() const { return cell_; }
  /// Returns a coordinate of a cell vector at control point k. There must be a cell.
  [[nodiscard]] double cell_coordinate(int vector, int k, int axis) const {
    return cell_[(vector * (degree_ + 1) + k) * dimension + axis];
  }

 private:
  const double* cell_ = nullptr;
  const double* points_ = nullptr;
  const double* radii_ = nullptr;
  std::ptrdiff_t stride_ = 0, radii_stride_ = 0;  // from bead to bead, in doubles
  int degree_ = 1;
  std::size_t beads_ = 0;
};

template <int DimensionValue, int DegreeValue>
class FixedCurves : public Curves<DimensionValue> {
 public:
  static constexpr int degree = DegreeValue;
  /// Views curves of this degree. For degree 0, views only their first control points.
  explicit FixedCurves(const Curves<DimensionValue>& curves) : Curves<DimensionValue>(curves) {}
};

template <int DimensionValue>
class LiftedCurves : public Curves<DimensionValue> {
 public:
  static constexpr int degree = 1;
  static constexpr bool is_lifted = true;
  using Vector = std::array<double, static_cast<std::size_t>(DimensionValue)>;

  LiftedCurves(const Curves<DimensionValue>& curves, const Vector& drift)
      : Curves<DimensionValue>(curves), drift_(drift) {}
  template <Motion M>
  requires(lifted<M>) explicit LiftedCurves(const M& motion) : Curves<DimensionValue>(motion) {
    for (int axis = 0; axis < DimensionValue; ++axis)
      drift_[static_cast<std::size_t>(axis)] = motion.drift(axis);
  }

  [[nodiscard]] double drift(int axis) const { return drift_[static_cast<std::size_t>(axis)]; }

 private:
  Vector drift_{};
};

/// A motion's curves, lifted or not.
template <Motion M>
using CurvesOf = std::conditional_t<lifted<M>, LiftedCurves<M::dimension>, Curves<M::dimension>>;

static_assert(Motion<Curves<3>> && Motion<FixedCurves<3, 1>> && Motion<LiftedCurves<3>>);

/// Copies of the curves of a few beads, numbered from 0. `C`: Curves or LiftedCurves.
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
  /// Returns the curves. The curves are valid during the life of this object.
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
