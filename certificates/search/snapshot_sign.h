#pragma once
// Signs of functions of beads where the beads are put (motions/curves/snapshot.h). Exact: in double with
// proved bounds, four at once, then with errors followed, then in whole numbers.

#include "certificates/search/classify_lanes.h"
#include "motions/curves/snapshot.h"
#include "motions/numbers/tracked_double.h"
#include "motions/views/integer_view.h"

namespace kds {

/// The sign of a function of beads: 1, 0 or -1.
template <class Function, int Dimension>
requires FunctionOfBeads<Function, Snapshot<Dimension>>
[[nodiscard]] int snapshot_sign(const Function& function, const Snapshot<Dimension>& placement) {
  using M = Snapshot<Dimension>;
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
[[KDS_LANES_TARGETS]] void snapshot_positive(
    const Snapshot<Dimension>& placement,
    const typename LanesView<Snapshot<Dimension>, bead_places<Function>>::Tuples& tuples, const Lanes& sides,
    Lanes::Mask& positive) {
  detail::ScaledLanes<0> lanes;
  detail::evaluate_lanes<Function>(placement, tuples, sides, lanes);
  positive = lanes.positive;
}

}  // namespace kds
