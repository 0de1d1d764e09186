#pragma once
// What four functions of one degree do from now on, by a first look at the signs of their coefficients. It
// says what BoundedPolynomial says one by one, and leaves to it what needs a subdivision. No allocation.

#include "certificates/base/kernel.h"
#include "certificates/filters/lanes_descent.h"

namespace kds {

/// The present time and what is known at it of each lane's function.
struct LanesNow {
  double lower = 0, upper = 0;
  bool isolating = false;
  unsigned at_own_root = 0;  ///< lanes, one bit each: see KnownAtStart
};

/// What became of each lane; of those in none not even the present sign is certain.
struct LanesSigns {
  Lanes::Mask positive{};  ///< never fails: all coefficients positive
  Lanes::Mask never{};     ///< never fails from now on
  Lanes::Mask violated{};  ///< negative now
  Lanes::Mask found{};     ///< fails once from now on: `descent` holds it
  Lanes::Mask unclear{};   ///< positive now, and yet to be searched
  Lanes::Mask known{};     ///< positive now although the value may not show it: at its own root
};
template <int Degree>
struct LanesOutcome : LanesSigns {
  LanesDescent<Degree> descent;  ///< polynomial and errors of all lanes that are not positive
};

/// Of functions that are not all positive (ScaledLanes); `uniform` is their bound's (error_bound.h).
template <int Degree>
void classify_lanes(const ScaledLanes<Degree>& functions, double uniform, Rounding rounding,
                    const LanesNow& now, LanesOutcome<Degree>& out);

template <int Degree>
requires(!is_compiled<Degree>) void classify_lanes(const ScaledLanes<Degree>& functions, double uniform,
                                                   Rounding rounding, const LanesNow& now,
                                                   LanesOutcome<Degree>& out) {
  LanesOutcome<any_degree> same;
  classify_lanes(ScaledLanes<any_degree>(functions), uniform, rounding, now, same);
  static_cast<LanesSigns&>(out) = same;
  same.descent.copy_to(out.descent);
}

}  // namespace kds
