#pragma once
// A view (motion_view.h) of four tuples of beads of one motion at once. A formula over this view names beads
// by their places in the tuple: 0, 1, 2 ... Radii are loaded only if `channels` selects them.

#include <array>

#include "motions/curves/bezier_motion.h"
#include "motions/numbers/bernstein.h"
#include "motions/numbers/lanes.h"
#include "motions/views/motion_view.h"

namespace kds {

template <Motion M, std::size_t Places, Channels channels = all_channels>
class LanesView {
 public:
  using Number = Lanes;
  static constexpr int dimension = M::dimension;
  static constexpr int degree = M::degree;
  using Tuples = std::array<std::array<BeadId, Places>, Lanes::width>;

  [[gnu::always_inline]] LanesView(const M& motion, const Tuples& t) {
    if constexpr (lifted<M>) {
      for (int axis = 0; axis < dimension; ++axis)
        drift_[static_cast<std::size_t>(axis)] = Lanes(motion.drift(axis));
    }
    if constexpr (channels.radii) {
      for (std::size_t place = 0; place < Places; ++place) {
        for (int k = 0; k <= degree; ++k) {
          radius_[place][static_cast<std::size_t>(k)] =
              Lanes::Vector{motion.radius(t[0][place], k), motion.radius(t[1][place], k),
                            motion.radius(t[2][place], k), motion.radius(t[3][place], k)};
        }
      }
    }
    for (std::size_t place = 0; place < Places; ++place) {
      for (int k = 0; k <= degree; ++k) {
        if constexpr (dimension == 3) {
          control_[place][static_cast<std::size_t>(k)] =
              Lanes::transposed(motion.control_point(t[0][place], k), motion.control_point(t[1][place], k),
                                motion.control_point(t[2][place], k), motion.control_point(t[3][place], k));
          continue;
        }
        for (int axis = 0; axis < dimension; ++axis) {
          control_[place][static_cast<std::size_t>(k)][static_cast<std::size_t>(axis)] =
              Lanes::Vector{motion.coordinate(t[0][place], k, axis), motion.coordinate(t[1][place], k, axis),
                            motion.coordinate(t[2][place], k, axis), motion.coordinate(t[3][place], k, axis)};
        }
        control_[place][static_cast<std::size_t>(k)][dimension] =
            Lanes::Vector{motion.weight(t[0][place], k), motion.weight(t[1][place], k),
                          motion.weight(t[2][place], k), motion.weight(t[3][place], k)};
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
      const auto place = static_cast<std::size_t>(k);
      const Lanes d = control_[i][place][static_cast<std::size_t>(axis)] -
                      control_[j][place][static_cast<std::size_t>(axis)];
      largest = Lanes::max(largest, Lanes::abs(d));
      result.scaled[place] = Lanes(static_cast<double>(binomial(degree, k))) * d;
    }
    return result;
  }

  [[gnu::always_inline]] Bernstein<Lanes, degree> of_radii(BeadId i, BeadId j, double sign) const {
    Bernstein<Lanes, degree> result;
    for (int k = 0; k <= degree; ++k) {
      const auto place = static_cast<std::size_t>(k);
      const Lanes sum = radius_[i][place] + Lanes(sign) * radius_[j][place];
      length_ = Lanes::max(length_, Lanes::abs(sum));
      result.scaled[place] = Lanes(static_cast<double>(binomial(degree, k))) * sum;
    }
    return result;
  }

  std::array<std::array<std::array<Lanes, dimension + 1>, degree + 1>, Places> control_;  // the weight last
  std::array<std::array<Lanes, degree + 1>, channels.radii ? Places : 0> radius_;
  std::array<Lanes, lifted<M> ? dimension : 0> drift_;
  mutable Lanes length_{0.0};
  mutable Lanes weight_{0.0};
};

}  // namespace kds
