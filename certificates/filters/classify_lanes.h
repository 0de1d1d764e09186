#pragma once
// Classifies four functions of one degree from the present time on, by a first look at the signs of their
// Bernstein coefficients. The answers are those of BoundedPolynomial for one function at a time. Functions
// that need a subdivision are left to later stages. No allocation.

#include "certificates/base/kernel.h"
#include "certificates/filters/lanes_descent.h"

namespace kds {

/// The present time, and what is known about each lane's function at that time.
struct LanesNow {
  double lower = 0, upper = 0;
  bool isolating = false;
  unsigned at_own_root = 0;  ///< lanes at their own root, one bit each: see KnownAtStart
};

/// The classification of each lane. If a lane is in no mask, not even its present sign is certain.
struct LanesSigns {
  Lanes::Mask positive{};  ///< never fails: all coefficients are positive
  Lanes::Mask never{};     ///< never fails from now on
  Lanes::Mask violated{};  ///< negative now
  Lanes::Mask found{};     ///< fails once from now on, in `descent`
  Lanes::Mask unclear{};   ///< positive now, still to be searched
  Lanes::Mask known{};     ///< positive now because it is at its own root, even if the value does not show it
};
template <int Degree>
struct LanesOutcome : LanesSigns {
  LanesDescent<Degree> descent;  ///< polynomials and errors of the lanes that are not positive
};

/// Classifies functions that are not all positive (ScaledLanes). `uniform` is from their error bound
/// (error_bound.h).
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
