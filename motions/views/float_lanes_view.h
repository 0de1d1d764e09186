#pragma once
// A view (motion_view.h) of eight or four pairs of beads of one motion at once, in floats: bead 1 of each
// pair minus its bead 0. Differences are computed in double and rounded to float once, so the distance from
// the origin does not matter. Lengths are first converted to a unit chosen by the caller, a power of two, so
// the narrow range of floats does not matter either.

#include <array>
#include <cassert>
#include <cmath>

#include "motions/curves/bezier_motion.h"
#include "motions/curves/lifted_motion.h"
#include "motions/numbers/bernstein.h"
#include "motions/numbers/float_lanes.h"
#include "motions/views/length_unit.h"

namespace kds {

template <Motion M, class LanesOfFloats = FloatLanes>
class FloatLanesView {
 public:
  using Number = LanesOfFloats;
  static constexpr int dimension = M::dimension;
  static constexpr int degree = M::degree;
  /// Takes one pair per lane: the first bead of each tuple and the bead at this place.
  template <std::size_t Places>
  [[gnu::always_inline]] FloatLanesView(const M& motion, const std::array<BeadId, Places>* tuples,
                                        std::size_t place, const LengthUnit& unit) {
    const Lanes::Vector scales = unit.scales<dimension>();
    for (int k = 0; k <= degree; ++k) {
      std::array<typename Number::Row, Number::width> rows;
      for (std::size_t lane = 0; lane < Number::width; ++lane)
        rows[lane] = Number::rounded(
            scales * (point(motion, tuples[lane][place], k) - point(motion, tuples[lane][0], k)));
      numbers_[static_cast<std::size_t>(k)] = Number::transposed(rows);
    }
    if constexpr (lifted<M>) {
      std::array<typename Number::Row, Number::width> rows;
      for (std::size_t lane = 0; lane < Number::width; ++lane)
        rows[lane] =
            Number::rounded(scales * (point(motion, tuples[lane][0], 1) - point(motion, tuples[lane][0], 0)));
      moved_ = Number::transposed(rows);
      for (std::size_t axis = 0; axis < dimension; ++axis)
        drift_[axis] = Number(static_cast<float>(unit.scale() * motion.drift(static_cast<int>(axis))));
    }
  }

  /// Returns bead 1 minus bead 0. No other difference is available.
  [[nodiscard, gnu::always_inline]] BernsteinVector<Number, degree, dimension> difference(
      [[maybe_unused]] BeadId i, [[maybe_unused]] BeadId j) const {
    assert(i == 1 && j == 0);
    BernsteinVector<Number, degree, dimension> result;
    for (std::size_t axis = 0; axis < dimension; ++axis) take(axis, result[axis], length_);
    return result;
  }
  [[nodiscard, gnu::always_inline]] Bernstein<Number, degree> weight_difference(
      [[maybe_unused]] BeadId i, [[maybe_unused]] BeadId j) const {
    assert(i == 1 && j == 0);
    Bernstein<Number, degree> result;
    take(dimension, result, weight_);
    return result;
  }
  [[nodiscard, gnu::always_inline]] Bernstein<Number, 1> lift_difference(BeadId i, BeadId j) const
      requires(lifted<M>) {
    return lift_of(*this, i, j);
  }
  [[nodiscard, gnu::always_inline]] std::array<Number, dimension> displacement(
      [[maybe_unused]] BeadId j) const requires(lifted<M>) {
    assert(j == 0);
    std::array<Number, dimension> result;
    for (std::size_t axis = 0; axis < dimension; ++axis) {
      length_ = Number::max(Number::max(length_, Number::abs(moved_[axis])), Number::abs(drift_[axis]));
      result[axis] = moved_[axis] - drift_[axis];
    }
    return result;
  }

  /// Returns a bound of all lengths returned so far.
  [[nodiscard, gnu::always_inline]] const Number& largest_length() const { return length_; }
  [[nodiscard, gnu::always_inline]] const Number& largest_weight() const { return weight_; }

 private:
  /// Returns a control point in double, the weight last.
  [[gnu::always_inline]] static Lanes::Vector point(const M& motion, BeadId bead, int k) {
    const double* p = motion.control_point(bead, k);
    if constexpr (dimension == 3) {
      return Lanes::load(p);
    } else {
      return Lanes::Vector{p[0], p[1], p[2], 0};
    }
  }
  [[gnu::always_inline]] void take(std::size_t channel, Bernstein<Number, degree>& polynomial,
                                   Number& largest) const {
    for (int k = 0; k <= degree; ++k) {
      const auto place = static_cast<std::size_t>(k);
      const Number& d = numbers_[place][channel];
      largest = Number::max(largest, Number::abs(d));
      polynomial.scaled[place] = Number(static_cast<float>(binomial(degree, k))) * d;
    }
  }

  std::array<std::array<Number, 4>, degree + 1> numbers_;  // the coordinates, then the weight
  std::array<Number, lifted<M> ? 4 : 0> moved_;
  std::array<Number, lifted<M> ? dimension : 0> drift_;
  mutable Number length_{0.0F};
  mutable Number weight_{0.0F};
};

}  // namespace kds
