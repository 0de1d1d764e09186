#pragma once
// Eight pairs of beads of one motion, seen at once in floats (motion_view.h): answers with what one bead of
// each pair differs by from the other, whatever two beads it is asked for. Differences are taken in double
// and rounded to float once, so that it does not matter how far from the origin beads are.

#include <array>

#include "motions/bernstein.h"
#include "motions/bezier_motion.h"
#include "motions/float_lanes.h"
#include "motions/lifted_motion.h"

namespace kds {

template <Motion M>
class FloatLanesView {
 public:
  using Number = FloatLanes;
  static constexpr int dimension = M::dimension;
  static constexpr int degree = M::degree;
  template <std::size_t Places>
  using Tuples = std::array<std::array<BeadId, Places>, FloatLanes::width>;

  /// Of each tuple the bead in this place, less the first one.
  template <std::size_t Places>
  [[gnu::always_inline]] FloatLanesView(const M& motion, const Tuples<Places>& tuples, std::size_t place) {
    for (int k = 0; k <= degree; ++k) {
      std::array<FloatLanes::Row, FloatLanes::width> rows;
      for (std::size_t lane = 0; lane < FloatLanes::width; ++lane)
        rows[lane] =
            FloatLanes::rounded(point(motion, tuples[lane][place], k) - point(motion, tuples[lane][0], k));
      numbers_[static_cast<std::size_t>(k)] = FloatLanes::transposed(rows);
    }
    if constexpr (lifted<M>) {
      std::array<FloatLanes::Row, FloatLanes::width> rows;
      for (std::size_t lane = 0; lane < FloatLanes::width; ++lane)
        rows[lane] =
            FloatLanes::rounded(point(motion, tuples[lane][0], 1) - point(motion, tuples[lane][0], 0));
      moved_ = FloatLanes::transposed(rows);
      for (std::size_t axis = 0; axis < dimension; ++axis)
        drift_[axis] = FloatLanes(static_cast<float>(motion.drift(static_cast<int>(axis))));
    }
  }

  [[nodiscard, gnu::always_inline]] BernsteinVector<FloatLanes, degree, dimension> difference(BeadId,
                                                                                              BeadId) const {
    BernsteinVector<FloatLanes, degree, dimension> result;
    for (std::size_t axis = 0; axis < dimension; ++axis) take(axis, result[axis], length_);
    return result;
  }
  [[nodiscard, gnu::always_inline]] Bernstein<FloatLanes, degree> weight_difference(BeadId, BeadId) const {
    Bernstein<FloatLanes, degree> result;
    take(dimension, result, weight_);
    return result;
  }
  [[nodiscard, gnu::always_inline]] Bernstein<FloatLanes, 1> lift_difference(BeadId i, BeadId j) const
      requires(lifted<M>) {
    return lift_of(*this, i, j);
  }
  [[nodiscard, gnu::always_inline]] std::array<FloatLanes, dimension> displacement(BeadId) const
      requires(lifted<M>) {
    std::array<FloatLanes, dimension> result;
    for (std::size_t axis = 0; axis < dimension; ++axis) {
      length_ = FloatLanes::max(FloatLanes::max(length_, FloatLanes::abs(moved_[axis])),
                                FloatLanes::abs(drift_[axis]));
      result[axis] = moved_[axis] - drift_[axis];
    }
    return result;
  }

  /// No length answered so far is larger.
  [[nodiscard, gnu::always_inline]] const FloatLanes& largest_length() const { return length_; }
  [[nodiscard, gnu::always_inline]] const FloatLanes& largest_weight() const { return weight_; }

 private:
  /// The weight last.
  [[gnu::always_inline]] static Lanes::Vector point(const M& motion, BeadId bead, int k) {
    const double* p = motion.control_point(bead, k);
    if constexpr (dimension == 3) {
      return Lanes::load(p);
    } else {
      return Lanes::Vector{p[0], p[1], p[2], 0};
    }
  }
  [[gnu::always_inline]] void take(std::size_t channel, Bernstein<FloatLanes, degree>& polynomial,
                                   FloatLanes& largest) const {
    for (int k = 0; k <= degree; ++k) {
      const auto place = static_cast<std::size_t>(k);
      const FloatLanes& d = numbers_[place][channel];
      largest = FloatLanes::max(largest, FloatLanes::abs(d));
      polynomial.scaled[place] = FloatLanes(static_cast<float>(binomial(degree, k))) * d;
    }
  }

  std::array<std::array<FloatLanes, 4>, degree + 1> numbers_;  // the weight after the coordinates
  std::array<FloatLanes, lifted<M> ? 4 : 0> moved_;
  std::array<FloatLanes, lifted<M> ? dimension : 0> drift_;
  mutable FloatLanes length_{0.0F};
  mutable FloatLanes weight_{0.0F};
};

}  // namespace kds
