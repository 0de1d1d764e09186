#pragma once
// Views (motion_view.h) of several tuples of beads of one motion at once, in doubles and in floats.

#include <array>
#include <cassert>
#include <cmath>

#include "motions/curves/bezier_motion.h"
#include "motions/curves/lifted_motion.h"
#include "motions/numbers/bernstein.h"
#include "motions/numbers/float_lanes.h"
#include "motions/numbers/lanes.h"
#include "motions/views/motion_view.h"

namespace kds {

/// A view of four tuples of beads. A formula over this view names beads by their indices in the tuple: 0, 1,
/// 2 ... Radii are loaded only if `channels` selects them.
template <Motion M, std::size_t Arity, Channels channels = all_channels>
class LanesView {
 public:
  using Number = Lanes;
  static constexpr int dimension = M::dimension;
  static constexpr int degree = M::degree;
  using Tuples = std::array<std::array<BeadId, Arity>, Lanes::width>;

  [[gnu::always_inline]] LanesView(const M& motion, const Tuples& t) {
    if constexpr (lifted<M>) {
      for (int axis = 0; axis < dimension; ++axis)
        drift_[static_cast<std::size_t>(axis)] = Lanes(motion.drift(axis));
    }
    if constexpr (channels.radii) {
      for (std::size_t index = 0; index < Arity; ++index) {
        for (int k = 0; k <= degree; ++k) {
          radius_[index][static_cast<std::size_t>(k)] =
              Lanes::Vector{motion.radius(t[0][index], k), motion.radius(t[1][index], k),
                            motion.radius(t[2][index], k), motion.radius(t[3][index], k)};
        }
      }
    }
    for (std::size_t index = 0; index < Arity; ++index) {
      for (int k = 0; k <= degree; ++k) {
        if constexpr (dimension == 3) {
          control_[index][static_cast<std::size_t>(k)] =
              Lanes::transposed(motion.control_point(t[0][index], k), motion.control_point(t[1][index], k),
                                motion.control_point(t[2][index], k), motion.control_point(t[3][index], k));
          continue;
        }
        for (int axis = 0; axis < dimension; ++axis) {
          control_[index][static_cast<std::size_t>(k)][static_cast<std::size_t>(axis)] =
              Lanes::Vector{motion.coordinate(t[0][index], k, axis), motion.coordinate(t[1][index], k, axis),
                            motion.coordinate(t[2][index], k, axis), motion.coordinate(t[3][index], k, axis)};
        }
        control_[index][static_cast<std::size_t>(k)][dimension] =
            Lanes::Vector{motion.weight(t[0][index], k), motion.weight(t[1][index], k),
                          motion.weight(t[2][index], k), motion.weight(t[3][index], k)};
      }
    }
  }

  [[nodiscard, gnu::always_inline]] BernsteinVector<Lanes, degree, dimension> difference(BeadId i,
                                                                                         BeadId j) const {
    BernsteinVector<Lanes, degree, dimension> result;
    for (int axis = 0; axis < dimension; ++axis)
      result[static_cast<std::size_t>(axis)] = difference(i, j, axis, length_);
    return result;
  }
  [[nodiscard, gnu::always_inline]] Bernstein<Lanes, degree> weight(BeadId i) const
      requires(channels.weights) {
    Bernstein<Lanes, degree> result;
    for (int k = 0; k <= degree; ++k) {
      const auto index = static_cast<std::size_t>(k);
      const Lanes& w = control_[i][index][dimension];
      // A ball may be larger than the distances between beads, so its weight counts as a length.
      length_ = Lanes::max(length_, Lanes::sqrt(Lanes::abs(w)) * Lanes(1 + 0x1p-50));
      result.scaled[index] = Lanes(static_cast<double>(binomial(degree, k))) * w;
    }
    return result;
  }
  [[nodiscard, gnu::always_inline]] Bernstein<Lanes, degree> weight_difference(BeadId i, BeadId j) const
      requires(channels.weights) {
    return difference(i, j, dimension, weight_);
  }
  [[nodiscard, gnu::always_inline]] Bernstein<Lanes, degree> radius_difference(BeadId i, BeadId j) const
      requires(channels.radii) {
    return of_radii(i, j, -1);
  }
  [[nodiscard, gnu::always_inline]] Bernstein<Lanes, degree> radius_sum(BeadId i, BeadId j) const
      requires(channels.radii) {
    return of_radii(i, j, 1);
  }

  [[nodiscard, gnu::always_inline]] Bernstein<Lanes, 1> lift_difference(BeadId i, BeadId j) const
      requires(channels.weights&& lifted<M>) {
    return lift_of(*this, i, j);
  }
  [[nodiscard, gnu::always_inline]] std::array<Lanes, dimension> displacement(BeadId bead) const
      requires(lifted<M>) {
    std::array<Lanes, dimension> result;
    for (std::size_t axis = 0; axis < dimension; ++axis) {
      const Lanes moved = control_[bead][1][axis] - control_[bead][0][axis];
      length_ = Lanes::max(Lanes::max(length_, Lanes::abs(moved)), Lanes::abs(drift_[axis]));
      result[axis] = moved - drift_[axis];
    }
    return result;
  }

  /// Returns the M of the error bound (motion_view.h), or a NaN if some weight difference exceeds its square.
  [[nodiscard, gnu::always_inline]] Lanes largest_length() const {
    return Lanes::choose(weight_ <= length_ * length_, length_, Lanes(__builtin_nan("")));
  }

 private:
  [[gnu::always_inline]] Bernstein<Lanes, degree> difference(BeadId i, BeadId j, int axis,
                                                             Lanes& largest) const {
    Bernstein<Lanes, degree> result;
    for (int k = 0; k <= degree; ++k) {
      const auto index = static_cast<std::size_t>(k);
      const Lanes d = control_[i][index][static_cast<std::size_t>(axis)] -
                      control_[j][index][static_cast<std::size_t>(axis)];
      largest = Lanes::max(largest, Lanes::abs(d));
      result.scaled[index] = Lanes(static_cast<double>(binomial(degree, k))) * d;
    }
    return result;
  }

  [[gnu::always_inline]] Bernstein<Lanes, degree> of_radii(BeadId i, BeadId j, double sign) const {
    Bernstein<Lanes, degree> result;
    for (int k = 0; k <= degree; ++k) {
      const auto index = static_cast<std::size_t>(k);
      const Lanes sum = radius_[i][index] + Lanes(sign) * radius_[j][index];
      length_ = Lanes::max(length_, Lanes::abs(sum));
      result.scaled[index] = Lanes(static_cast<double>(binomial(degree, k))) * sum;
    }
    return result;
  }

  std::array<std::array<std::array<Lanes, dimension + 1>, degree + 1>, Arity> control_;  // the weight last
  std::array<std::array<Lanes, degree + 1>, channels.radii ? Arity : 0> radius_;
  std::array<Lanes, lifted<M> ? dimension : 0> drift_;
  mutable Lanes length_{0.0};
  mutable Lanes weight_{0.0};
};

/// A unit of length 2^exponent for views in floats, as the factors that convert differences of coordinates
/// and of weights to it. The conversion is exact unless a double overflows or the result is below the
/// smallest float.
class LengthUnit {
 public:
  explicit LengthUnit(int exponent = 0) : scale_(std::ldexp(1.0, -exponent)) {}
  [[nodiscard, gnu::always_inline]] double scale() const { return scale_; }
  /// Returns the factors of a control point's coordinates, then of its weight.
  template <int dimension>
  [[nodiscard, gnu::always_inline]] Lanes::Vector scales() const {
    if constexpr (dimension == 3) return Lanes::Vector{scale_, scale_, scale_, scale_ * scale_};
    return Lanes::Vector{scale_, scale_, scale_ * scale_, 0};
  }

 private:
  double scale_;
};

/// A view of eight or four pairs of beads in floats: bead 1 of each pair minus its bead 0. Differences are
/// computed in double and rounded to float once, so the distance from the origin does not matter. Lengths are
/// first converted to a unit chosen by the caller, a power of two, so the narrow range of floats does not
/// matter either.
template <Motion M, class LanesOfFloats = FloatLanes>
class FloatLanesView {
 public:
  using Number = LanesOfFloats;
  static constexpr int dimension = M::dimension;
  static constexpr int degree = M::degree;
  /// Takes one pair per lane: the first bead of each tuple and the bead at this index.
  template <std::size_t Arity>
  [[gnu::always_inline]] FloatLanesView(const M& motion, const std::array<BeadId, Arity>* tuples,
                                        std::size_t index, const LengthUnit& unit) {
    const Lanes::Vector scales = unit.scales<dimension>();
    for (int k = 0; k <= degree; ++k) {
      std::array<typename Number::Row, Number::width> rows;
      for (std::size_t lane = 0; lane < Number::width; ++lane)
        rows[lane] = Number::rounded(
            scales * (point(motion, tuples[lane][index], k) - point(motion, tuples[lane][0], k)));
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
      const auto index = static_cast<std::size_t>(k);
      const Number& d = numbers_[index][channel];
      largest = Number::max(largest, Number::abs(d));
      polynomial.scaled[index] = Number(static_cast<float>(binomial(degree, k))) * d;
    }
  }

  std::array<std::array<Number, 4>, degree + 1> numbers_;  // the coordinates, then the weight
  std::array<Number, lifted<M> ? 4 : 0> moved_;
  std::array<Number, lifted<M> ? dimension : 0> drift_;
  mutable Number length_{0.0F};
  mutable Number weight_{0.0F};
};

}  // namespace kds
