#pragma once
// The double stage for four certificates of one type at once: coefficients with their errors and the first
// look at their signs. It says what BoundedPolynomial says one by one, and leaves to it what needs a
// subdivision. No allocation.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <tuple>

#include "certificates/base/certificate.h"
#include "certificates/base/kernel.h"
#include "certificates/filters/error_bound.h"
#include "certificates/filters/lanes_descent.h"
#include "motions/views/lanes_view.h"

namespace kds {

/// The present time and what is known at it of each lane's function.
struct LanesNow {
  double lower = 0, upper = 0;
  bool isolating = false;
  unsigned at_own_root = 0;  ///< lanes, one bit each: see KnownAtStart
};

/// What became of each lane; of those in none not even the present sign is certain.
template <int Degree>
struct LanesOutcome {
  Lanes::Mask positive{};        ///< never fails: all coefficients positive
  Lanes::Mask never{};           ///< never fails from now on
  Lanes::Mask violated{};        ///< negative now
  Lanes::Mask found{};           ///< fails once from now on: `descent` holds it
  Lanes::Mask unclear{};         ///< positive now, and yet to be searched
  Lanes::Mask known{};           ///< positive now although the value may not show it: at its own root
  LanesDescent<Degree> descent;  ///< polynomial and errors of all lanes that are not positive
};

/// The filter's constants for a certificate type and a motion of constant degree (error_bound.h).
template <int Degree>
struct LanesBound {
  int power = 0;
  std::array<double, static_cast<std::size_t>(Degree) + 1> coefficient{};
  double uniform = 0;

  explicit LanesBound(const ErrorBound& bound) : power(bound.power), uniform(bound.uniform) {
    std::copy_n(bound.coefficient.begin(), coefficient.size(), coefficient.begin());
  }
};

template <class Certificate>
inline constexpr std::size_t bead_places = std::tuple_size_v<decltype(Certificate{}.beads)>;

namespace detail {

/// The scaled Bernstein coefficients of four functions, and the scale of their errors.
template <int Degree>
struct ScaledLanes {
  LanesCoefficients<Degree> scaled;
  Lanes error_scale;     ///< M^h, or a NaN where the bound is not proved
  Lanes::Mask positive;  ///< all coefficients certainly
};

/// `sides`: 1 or -1, by which a lane's formula is multiplied.
template <class Certificate, Motion M, int Degree>
[[gnu::always_inline]] inline void evaluate_lanes(
    const M& motion, const typename LanesView<M, bead_places<Certificate>>::Tuples& tuples,
    const Lanes& sides, const LanesBound<Degree>& bound, double charge, ScaledLanes<Degree>& lanes) {
  decltype(Certificate{}.beads) places{};
  for (std::size_t p = 0; p < places.size(); ++p) places[p] = static_cast<BeadId>(p);
  const LanesView<M, bead_places<Certificate>, channels_of<Certificate>> view(motion, tuples);
  const auto function = Certificate::formula(view, places);

  const Lanes length = view.largest_length();
  Lanes scale(1.0);
  for (int i = 0; i < bound.power; ++i) scale = scale * length;
  scale =
      Lanes::choose((scale >= Lanes(0x1p-900)) & (scale <= Lanes(0x1p900)), scale, Lanes(__builtin_nan("")));
  scale = scale * Lanes(charge);
  lanes.error_scale = scale;
  lanes.positive = scale >= Lanes(0.0);
  for (std::size_t k = 0; k <= Degree; ++k) {
    lanes.scaled[k] = sides * function.scaled[k];
    lanes.positive &= lanes.scaled[k] > Lanes(bound.coefficient[k]) * scale;
  }
}

/// Plain coefficients and the errors that go with them.
template <int Degree>
[[gnu::always_inline]] inline void bound_lanes(const ScaledLanes<Degree>& given, double uniform_bound,
                                               double charge, LanesDescent<Degree>& lanes) {
  Lanes largest(0.0);
  for (std::size_t k = 0; k <= Degree; ++k) {
    lanes.bernstein[k] = given.scaled[k] / Lanes(static_cast<double>(binomial(Degree, static_cast<int>(k))));
    largest = Lanes::max(largest, Lanes::abs(lanes.bernstein[k]));
  }
  const Lanes uniform = Lanes::choose(largest >= Lanes(0x1p-900), Lanes(uniform_bound) * given.error_scale,
                                      Lanes(__builtin_nan("")));
  // A hair, so that what is known to be positive seems to be.
  const Lanes least(charge == 0 ? 0x1p-1000 : 0.0);
  lanes.value_error = uniform + Lanes(charge * value_rounding(Degree)) * largest + least;
  lanes.local_error = uniform + Lanes(charge * local_rounding(Degree)) * largest + least;
}

/// How far from its value at the upper end a function may be elsewhere in the present bracket.
template <int Degree>
[[gnu::always_inline]] inline Lanes change_within(const LanesDescent<Degree>& lanes, double lower,
                                                  double upper) {
  if (!(lower < upper)) return Lanes(0.0);
  // |p'| <= Degree * steepest; coefficients err by value_error each.
  Lanes steepest(0.0);
  for (std::size_t k = 0; k < Degree; ++k)
    steepest = Lanes::max(steepest, Lanes::abs(lanes.bernstein[k + 1] - lanes.bernstein[k]));
  return Lanes(static_cast<double>(Degree)) * (steepest + Lanes(2.0) * lanes.value_error) *
         Lanes((upper - lower) * (1 + 0x1p-40));
}

}  // namespace detail

/// What the four certificates do from now on.
template <class Certificate, Motion M, int Degree>
[[KDS_LANES_TARGETS]] void classify_lanes(
    const M& motion, const typename LanesView<M, bead_places<Certificate>>::Tuples& tuples,
    const Lanes& sides, const LanesBound<Degree>& bound, Rounding rounding, const LanesNow& now,
    LanesOutcome<Degree>& out) {
  const double charge = rounding == Rounding::charged ? 1 : 0;
  detail::ScaledLanes<Degree> given;
  detail::evaluate_lanes<Certificate>(motion, tuples, sides, bound, charge, given);
  out.positive = given.positive;
  if (Lanes::all(out.positive)) return;
  detail::bound_lanes(given, bound.uniform, charge, out.descent);
  auto right = out.descent.bernstein;  // the part after now
  if (now.upper > 0) casteljau(right, Lanes(now.upper));
  // At its own root the bracket holds no other one, and at its upper end the function is positive.
  Lanes::Mask at_own_root{};
  for (unsigned lane = 0; lane < Lanes::width; ++lane)
    at_own_root[lane] = (now.at_own_root >> lane & 1U) != 0 ? -1 : 0;
  const Lanes::Mask known = now.isolating ? at_own_root : Lanes::Mask{};
  const Lanes start = right[0];
  right[0] = known_positive(start, known, out.descent.local_error);
  const Lanes change = Lanes::choose(at_own_root, Lanes(now.isolating ? 0.0 : __builtin_inf()),
                                     detail::change_within(out.descent, now.lower, now.upper));
  const Lanes::Mask starts_positive = right[0] > out.descent.local_error + change;
  out.violated = right[0] < -(out.descent.local_error + change);
  const LanesShape shape = shape_of(right, out.descent.local_error);
  out.never = shape.positive & starts_positive & ~out.positive;
  out.found = shape.one_descent & starts_positive;
  out.unclear = starts_positive & ~(out.positive | shape.positive | shape.one_descent);
  out.known = known;
  right[0] = Lanes::choose(out.unclear, start, right[0]);  // those are subdivided: the polynomial as it is
  out.descent.part = right;
  out.descent.lower = Lanes(now.upper);
  out.descent.upper = Lanes(1.0);
}

}  // namespace kds
