#pragma once
// Evaluates the functions of four certificates of one type at once: Bernstein coefficients in double, the
// scale of their errors, and whether all coefficients are certainly positive. Further analysis depends on the
// degree alone (classify_lanes.h). No allocation.

#include <algorithm>
#include <array>
#include <cstddef>
#include <tuple>

#include "certificates/base/certificate.h"
#include "certificates/base/kernel.h"
#include "certificates/filters/error_bound.h"
#include "certificates/filters/lanes_polynomial.h"
#include "motions/views/lanes_view.h"

namespace kds {

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

namespace detail {

/// Inlined into callers that are themselves compiled for lanes.
template <class Certificate, Motion M, int Degree>
[[gnu::always_inline]] inline void evaluate_in_line(
    const M& motion, const typename LanesView<M, bead_places<Certificate>>::Tuples& tuples,
    const Lanes& sides, const LanesBound<Degree>& bound, double charge, ScaledLanes<Degree>& lanes,
    const BeadsOf<Certificate>& like = {}) {
  const BeadsOf<Certificate> places = in_places<Certificate>(like);  // constants for the compiler
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

}  // namespace detail

/// Evaluates four certificates. `sides` is 1 or -1 per lane and multiplies its formula. `like`: the beads of
/// any of the certificates.
template <class Certificate, Motion M, int Degree>
[[KDS_LANES_TARGETS]] void evaluate_lanes(
    const M& motion, const typename LanesView<M, bead_places<Certificate>>::Tuples& tuples,
    const Lanes& sides, const LanesBound<Degree>& bound, Rounding rounding, ScaledLanes<Degree>& lanes,
    const BeadsOf<Certificate>& like) {
  detail::evaluate_in_line<Certificate>(motion, tuples, sides, bound, charge_of(rounding), lanes, like);
}

}  // namespace kds
