#pragma once
// The slack of a certificate: how far any coordinate difference of two of its beads may move away from its
// value at one position before the certificate can fail. A difference moves by at most the sum of how far
// both beads stray, so each bead may stray half the slack. The slack stays valid for as many steps as the
// beads stay near, and needs no polynomial.
//
// Derivation. The formula is evaluated at the position over numbers with errors (rounding_error.h), where
// each coordinate difference has an error of `reach`. The result is a value and a bound E(reach): while no
// difference moves by more than `reach`, the formula is within E(reach) of the value, rounding included.
// Intermediate values do not depend on the reach, so E is a polynomial in the reach without negative
// coefficients, and hence convex:
//   E(s reach) <= E(0) + s E(reach) for s from 0 to 1.
// E(0) consists of rounding alone. Operation by operation it is at most what the formula's magnitudes give
// (motions/numbers/rounding_error.h), which are used instead. The sign therefore holds while no difference
// moves by more than s reach, with s = (value - E(0)) / E(reach), at most 1.
//
// Weights and radii must stay constant. The slack is proved; it is 0 if nothing can be proved.

#include <cmath>

#include "certificates/filters/formula_lanes.h"
#include "motions/numbers/rounding_error.h"

namespace kds {

/// A view of four tuples of beads at the start of a step, in which each coordinate difference has an error of
/// `reach`.
template <Motion M, std::size_t Arity, Channels channels>
class ReachView {
 public:
  using Number = Tracked<Lanes>;
  static constexpr int dimension = M::dimension;
  static constexpr int degree = 0;
  using Tuples = typename LanesView<M, Arity, channels>::Tuples;

  [[gnu::always_inline]] ReachView(const M& motion, const Tuples& tuples) : view_(motion, tuples) {
    for (std::size_t argument = 1; argument < Arity; ++argument) {
      for (const auto& coordinate : view_.difference(static_cast<BeadId>(argument), 0))
        longest_ = Lanes::max(longest_, Lanes::abs(coordinate.scaled[0]));
    }
  }

  [[gnu::always_inline]] void set_reach(const Lanes& reach) { reach_ = reach; }
  /// Returns the largest coordinate difference to the first bead.
  [[nodiscard, gnu::always_inline]] const Lanes& longest() const { return longest_; }
  /// Returns the M of the error bound (motions/numbers/rounding_error.h) at the start or in the step, or a
  /// NaN.
  [[nodiscard, gnu::always_inline]] Lanes largest_length() const { return view_.largest_length(); }

  [[nodiscard, gnu::always_inline]] BernsteinVector<Number, 0, dimension> difference(BeadId i,
                                                                                     BeadId j) const {
    const auto moving = view_.difference(i, j);
    BernsteinVector<Number, 0, dimension> result;
    for (std::size_t axis = 0; axis < result.size(); ++axis)
      result[axis].scaled[0] = rounded(moving[axis].scaled[0], reach_);
    return result;
  }
  [[nodiscard, gnu::always_inline]] Bernstein<Number, 0> weight_difference(BeadId i, BeadId j) const
      requires(channels.weights) {
    return {{rounded(view_.weight_difference(i, j).scaled[0], Lanes(0.0))}};
  }
  [[nodiscard, gnu::always_inline]] Bernstein<Number, 0> radius_difference(BeadId i, BeadId j) const
      requires(channels.radii) {
    return {{rounded(view_.radius_difference(i, j).scaled[0], Lanes(0.0))}};
  }
  [[nodiscard, gnu::always_inline]] Bernstein<Number, 0> radius_sum(BeadId i, BeadId j) const
      requires(channels.radii) {
    return {{rounded(view_.radius_sum(i, j).scaled[0], Lanes(0.0))}};
  }

 private:
  [[gnu::always_inline]] static Number rounded(const Lanes& value, const Lanes& error) {
    return {value, error + Lanes(Number::unit_roundoff) * Lanes::abs(value)};
  }

  LanesView<M, Arity, channels> view_;
  Lanes reach_{0.0};
  Lanes longest_{0.0};
};

/// The error of the formula at one position from rounding alone: at most error * M^power.
template <class Certificate, int Dimension>
inline const Magnitude magnitude_at_position =
    function_of(Certificate{}, MagnitudeView<Dimension, 0>()).scaled[0];

/// Computes the slacks of four certificates at the start of the motion's step.
template <class Certificate, Motion M>
[[KDS_LANES_TARGETS]] void slack_lanes(
    const M& motion,
    const typename LanesView<M, bead_arity<Certificate>, channels_of<Certificate>>::Tuples& tuples,
    const Lanes& sides, Lanes& slack) {
  constexpr double share_of_length = 1.0 / 16;  // long enough for most, and E is nearly linear
  constexpr double inflation = 1 + 0x1p-30;
  decltype(Certificate{}.beads) arguments{};
  for (std::size_t p = 0; p < arguments.size(); ++p) arguments[p] = static_cast<BeadId>(p);
  ReachView<M, bead_arity<Certificate>, channels_of<Certificate>> view(motion, tuples);
  const Lanes reach = Lanes(share_of_length) * view.longest();
  view.set_reach(reach);
  const auto function = Certificate::formula(view, arguments).scaled[0];

  const Magnitude& magnitude = magnitude_at_position<Certificate, M::dimension>;
  const Lanes length = view.largest_length();
  Lanes scale(1.0);
  for (int i = 0; i < magnitude.power; ++i) scale = scale * length;
  const Lanes rounding = Lanes(magnitude.error * inflation) * scale;
  const Lanes above = sides * function.value - rounding;
  const Lanes share = Lanes::min(above / (function.error * Lanes(inflation)), Lanes(1.0));
  const Lanes::Mask proved = (above > Lanes(0.0)) & (share > Lanes(0.0)) & (scale >= Lanes(0x1p-900)) &
                             (scale <= Lanes(0x1p900)) & (reach > Lanes(0x1p-200));
  slack = Lanes::choose(proved, share * reach * Lanes(1 - 0x1p-30), Lanes(0.0));
}

}  // namespace kds
