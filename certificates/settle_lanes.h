#pragma once
// The double stage for four certificates of one type at once: coefficients with their errors and the first
// look at their signs. It says what BoundedPolynomial says one by one, and leaves to it what needs a
// subdivision. No allocation.

#include <array>
#include <cmath>
#include <cstddef>
#include <tuple>

#include "certificates/certificate.h"
#include "certificates/error_bound.h"
#include "certificates/isolate_lanes.h"
#include "motions/lanes_view.h"

namespace kds {

/// The present time and what is known at it of each lane's function.
struct LanesNow {
  double lower = 0, upper = 0;
  bool isolating = false;
  unsigned at_own_root = 0;  ///< lanes, one bit each: see Birth
};

/// What became of each lane; of those in none not even the present sign is certain.
template <int Degree>
struct LanesOutcome {
  Lanes::Mask positive{};        ///< never fails: all coefficients positive
  Lanes::Mask never{};           ///< never fails from now on
  Lanes::Mask found{};           ///< fails once from now on: `descent` holds it
  Lanes::Mask unclear{};         ///< positive now, and yet to be searched
  LanesDescent<Degree> descent;  ///< polynomial and errors of all lanes that are not positive
};

template <class Certificate>
inline constexpr std::size_t bead_places = std::tuple_size_v<decltype(Certificate{}.beads)>;

/// `sides`: 1 or -1, by which a lane's formula is multiplied.
template <class Certificate, Motion M, int Degree>
[[KDS_LANES_TARGETS]] void settle_lanes(const M& motion,
                                        const typename LanesView<M, bead_places<Certificate>>::Tuples& tuples,
                                        const Lanes& sides, const LanesNow& now, LanesOutcome<Degree>& out) {
  decltype(Certificate{}.beads) places{};
  for (std::size_t p = 0; p < places.size(); ++p) places[p] = static_cast<BeadId>(p);
  const LanesView<M, bead_places<Certificate>> view(motion, tuples);
  const auto function = Certificate::formula(view, places);
  const auto& bound = error_bound<Certificate, M>;

  const Lanes length = view.largest_length();
  Lanes scale(1.0);
  for (int i = 0; i < bound.power; ++i) scale = scale * length;
  scale =
      Lanes::choose((scale >= Lanes(0x1p-900)) & (scale <= Lanes(0x1p900)), scale, Lanes(__builtin_nan("")));

  auto& c = out.descent.bernstein;
  Lanes::Mask positive = scale >= Lanes(0.0);
  Lanes largest(0.0);
  for (std::size_t k = 0; k <= Degree; ++k) {
    const Lanes signed_value = sides * function.scaled[k];
    positive &= signed_value > Lanes(bound.coefficient[k]) * scale;
    c[k] = signed_value / Lanes(static_cast<double>(binomial(Degree, static_cast<int>(k))));
    largest = Lanes::max(largest, Lanes::abs(c[k]));
  }
  out.positive = positive;
  if (Lanes::all(positive)) return;

  const Lanes uniform =
      Lanes::choose(largest >= Lanes(0x1p-900), Lanes(bound.uniform) * scale, Lanes(__builtin_nan("")));
  out.descent.value_error = uniform + Lanes(value_rounding(Degree)) * largest;
  out.descent.local_error = uniform + Lanes(local_rounding(Degree)) * largest;

  // The part after now.
  auto right = c;
  if (now.upper > 0) casteljau(right, Lanes(now.upper));
  Lanes reach(0.0);  // how much less the function may be elsewhere in the present bracket
  if (now.lower < now.upper) {
    Lanes steepest(0.0);
    for (std::size_t k = 0; k < Degree; ++k) steepest = Lanes::max(steepest, Lanes::abs(c[k + 1] - c[k]));
    reach = Lanes(static_cast<double>(Degree)) * (steepest + Lanes(2.0) * out.descent.value_error) *
            Lanes((now.upper - now.lower) * (1 + 0x1p-40));
  }
  Lanes::Mask at_own_root{};
  for (unsigned lane = 0; lane < Lanes::width; ++lane)
    at_own_root[lane] = (now.at_own_root >> lane & 1U) != 0 ? -1 : 0;
  reach = Lanes::choose(at_own_root, Lanes(now.isolating ? 0.0 : __builtin_inf()), reach);
  const Lanes::Mask starts_positive = right[0] > out.descent.local_error + reach;

  const LanesShape shape = shape_of(right, out.descent.local_error);
  out.never = shape.positive & starts_positive & ~positive;
  out.found = shape.one_descent & starts_positive;
  out.unclear = starts_positive & ~(shape.positive | shape.one_descent);
  out.descent.part = right;
  out.descent.lower = Lanes(now.upper);
  out.descent.upper = Lanes(1.0);
}

}  // namespace kds
