#pragma once
// Evaluates the functions of four certificates of one type at once: Bernstein coefficients in double, the
// scale of their errors, and whether all coefficients are certainly positive. Further analysis depends on the
// degree alone (lanes_descent.h). No allocation.

#include <algorithm>
#include <array>
#include <cstddef>
#include <tuple>

#include "certificates/base/certificate.h"
#include "certificates/filters/bounded_polynomial.h"
#include "certificates/filters/lanes_descent.h"
#include "motions/views/lanes_view.h"

namespace kds {

/// The filter's constants for a certificate type and a motion of constant degree (bounded_polynomial.h).
template <int Degree>
struct LanesBound {
  int power = 0;
  std::array<double, static_cast<std::size_t>(Degree) + 1> coefficient{};
  double uniform = 0;

  explicit LanesBound(const ErrorBound& bound) : power(bound.power), uniform(bound.uniform) {
    std::copy_n(bound.coefficient.begin(), coefficient.size(), coefficient.begin());
  }
};

namespace detail {

/// Inlined into callers that are themselves compiled for lanes.
template <class Certificate, Motion M, int Degree>
[[gnu::always_inline]] inline void evaluate_in_line(
    const M& motion, const typename LanesView<M, bead_arity<Certificate>>::Tuples& tuples, const Lanes& sides,
    const LanesBound<Degree>& bound, ScaledLanes<Degree>& lanes, const BeadsOf<Certificate>& like = {}) {
  const BeadsOf<Certificate> arguments = argument_numbers<Certificate>(like);  // known at compile time
  const LanesView<M, bead_arity<Certificate>, channels_of<Certificate>> view(motion, tuples);
  const auto function = Certificate::formula(view, arguments);

  const Lanes length = view.largest_length();
  Lanes scale(1.0);
  for (int i = 0; i < bound.power; ++i) scale = scale * length;
  scale =
      Lanes::choose((scale >= Lanes(0x1p-900)) & (scale <= Lanes(0x1p900)), scale, Lanes(__builtin_nan("")));
  lanes.error_scale = scale;
  lanes.positive = scale >= Lanes(0.0);
  for (std::size_t k = 0; k <= Degree; ++k) {
    lanes.scaled[k] = sides * function.scaled[k];
    lanes.positive &= lanes.scaled[k] > Lanes(bound.coefficient[k]) * scale;
  }
}

}  // namespace detail

/// Evaluates four certificates. `sides` is 1 or -1 per lane and multiplies its formula. `like`: the beads of
/// any of the certificates.
template <class Certificate, Motion M, int Degree>
[[KDS_LANES_TARGETS]] void evaluate_lanes(
    const M& motion, const typename LanesView<M, bead_arity<Certificate>>::Tuples& tuples, const Lanes& sides,
    const LanesBound<Degree>& bound, ScaledLanes<Degree>& lanes, const BeadsOf<Certificate>& like) {
  detail::evaluate_in_line<Certificate>(motion, tuples, sides, bound, lanes, like);
}

// The signs of four functions of bead centres (such as orientations) at once, at a moment that is known as a
// bracket.
//
// Values are computed at the upper end u of the bracket. Consider a difference of two centres of degree n in
// time, with control points of size at most M. At u it is the mean of its control points with weights C(n,k)
// (1-u)^(n-k) u^k. The computed value has an error of less than (4n + 4) 2^-53 M, and within a bracket of
// length b the difference changes by at most 2 n b M.
//
// If the rounding and the change together are below 2^-25 M, they are at most the error of rounding to float.
// The function of these differences, evaluated in double, then has at most the error of an evaluation in
// float from exact differences, as magnitudes of 24 digits give it (motions/numbers/rounding_error.h). The
// bound is proved for 2^-900 <= M^h <= 2^900, as in bounded_polynomial.h. No allocation.

/// A view of four tuples of beads at time u.
template <Motion M, std::size_t Arity>
class LanesMomentView {
 public:
  using Number = Lanes;
  static constexpr int dimension = M::dimension;
  static constexpr int degree = 0;
  using Tuples = typename LanesView<M, Arity, Channels{}>::Tuples;

  [[gnu::always_inline]] LanesMomentView(const M& motion, const Tuples& tuples, double u)
      : whole_(motion, tuples) {
    for (std::size_t k = 0; k < weights_.size(); ++k) {
      double weight = 1;
      for (std::size_t i = 0; i + 1 < weights_.size(); ++i) weight *= i < k ? u : 1 - u;
      weights_[k] = weight;
    }
  }

  [[nodiscard, gnu::always_inline]] BernsteinVector<Lanes, 0, dimension> difference(BeadId i,
                                                                                    BeadId j) const {
    const auto curve = whole_.difference(i, j);
    BernsteinVector<Lanes, 0, dimension> result;
    for (std::size_t axis = 0; axis < dimension; ++axis) {
      Lanes sum = Lanes(weights_[0]) * curve[axis].scaled[0];
      for (std::size_t k = 1; k < weights_.size(); ++k) sum += Lanes(weights_[k]) * curve[axis].scaled[k];
      result[axis].scaled[0] = sum;
    }
    return result;
  }

  [[nodiscard, gnu::always_inline]] Lanes largest_length() const { return whole_.largest_length(); }

 private:
  LanesView<M, Arity, Channels{}> whole_;
  std::array<double, static_cast<std::size_t>(M::degree) + 1> weights_;
};

namespace detail {

/// The error of a function's value, as a multiple of M^power.
struct MomentBound {
  double error;
  int power;
};

template <class Function, int Dimension>
MomentBound derive_moment_bound() {
  constexpr double inflation = 1 + 0x1p-20;
  const auto value = function_of(Function{}, MagnitudeView<Dimension, 0, false, MagnitudeIn<24>>()).scaled[0];
  return {value.error * inflation, value.power};
}

template <class Function, int Dimension>
inline const MomentBound moment_bound = derive_moment_bound<Function, Dimension>();

}  // namespace detail

/// Finds whether all four functions, each times its side (1 or -1), are certainly positive on all of [lower,
/// upper].
template <class Function, Motion M>
requires(!channels_of<Function>.weights && !channels_of<Function>.radii)  //
    [[KDS_LANES_TARGETS]] void positive_at_moment(
        const M& motion, const typename LanesMomentView<M, bead_arity<Function>>::Tuples& tuples,
        const Lanes& sides, double lower, double upper, bool& all_positive,
        const BeadsOf<Function>& like = {}) {
  constexpr int degree = M::degree;
  all_positive = false;
  if (!((2 * degree) * (upper - lower) + (4 * degree + 4) * 0x1p-53 <= 0x1p-25)) return;
  const BeadsOf<Function> arguments = argument_numbers<Function>(like);  // known at compile time
  const LanesMomentView<M, bead_arity<Function>> view(motion, tuples, upper);
  const Lanes value = sides * Function::formula(view, arguments).scaled[0];
  const auto& bound = detail::moment_bound<Function, M::dimension>;
  const Lanes length = view.largest_length();
  Lanes scale(1.0);
  for (int i = 0; i < bound.power; ++i) scale = scale * length;
  all_positive = Lanes::all((scale >= Lanes(0x1p-900)) & (scale <= Lanes(0x1p900)) &
                            (value > Lanes(bound.error) * scale));
}

}  // namespace kds
