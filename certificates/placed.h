#pragma once
// Signs of functions of beads where the beads are put (motions/placement.h). Exact: in double with proved
// bounds, four at once, then with errors followed, then in whole numbers.

#include "certificates/settle_lanes.h"
#include "motions/placement.h"
#include "motions/tracked_double.h"
#include "motions/whole_view.h"

namespace kds {

/// The sign of a function of beads: 1, 0 or -1.
template <class Function, int Dimension>
requires FunctionOfBeads<Function, Placement<Dimension>>
[[nodiscard]] int placed_sign(const Function& function, const Placement<Dimension>& placement) {
  using M = Placement<Dimension>;
  constexpr Channels channels = channels_of<Function>;
  const auto sign_of = [](double value, double error) { return value > error ? 1 : value < -error ? -1 : 0; };
  const DoubleView<M> view(placement);
  const double value = function_of(function, view).scaled[0];
  const auto& bound = error_bound<Function, M>;
  if (const int sign = sign_of(value, bound.coefficient[0] * bound.scale(view.largest_length())); sign != 0)
    return sign;
  const TrackedDouble tracked =
      function_of(function, TrackedView<M, channels>(placement, function.beads)).scaled[0];
  if (const int sign = sign_of(tracked.value, tracked.error * TrackedDouble::inflation); sign != 0)
    return sign;
  return function_of(function, IntegerView<M, channels>(placement, function.beads)).scaled[0].sign();
}

/// Which of four formulas, each times its side (1 or -1), are certainly positive.
template <class Function, int Dimension>
[[KDS_LANES_TARGETS]] void placed_positive(
    const Placement<Dimension>& placement,
    const typename LanesView<Placement<Dimension>, bead_places<Function>>::Tuples& tuples, const Lanes& sides,
    Lanes::Mask& positive) {
  detail::ScaledLanes<0> lanes;
  detail::evaluate_lanes<Function>(placement, tuples, sides, lanes);
  positive = lanes.positive;
}

}  // namespace kds
