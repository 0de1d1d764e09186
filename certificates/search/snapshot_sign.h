#pragma once
// The signs of functions of beads at a snapshot (motions/curves/positions.h). Exact: first in double with
// proved bounds (four at once or one), then with running error bounds, then with integers.

#include <cmath>

#include "certificates/filters/formula_lanes.h"
#include "certificates/formulas/function_values.h"
#include "motions/curves/snapshot.h"

namespace kds {

/// Returns the sign of a function of beads: 1, 0 or -1.
template <class Function, int Dimension>
[[nodiscard]] int snapshot_sign(const Function& function, const Snapshot<Dimension>& snapshot) {
  using Values = FunctionValues<Function, Curves<Dimension>>;
  const DoubleView<Snapshot<Dimension>> view(snapshot);
  const double value = function_of(function, view).scaled[0];
  const ErrorBound& bound = Values::error_bound(0);
  if (std::abs(value) > bound.coefficient[0] * bound.scale(view.largest_length())) return value > 0 ? 1 : -1;
  return Values::sign_at_rest(function, Curves<Dimension>(snapshot));
}

namespace detail {

template <class Function, int Dimension>
inline const LanesBound<0> bound_at_rest{FunctionValues<Function, Curves<Dimension>>::error_bound(0)};

}  // namespace detail

/// Finds which of four formulas, each times its side (1 or -1), are certainly positive.
template <class Function, int Dimension>
[[KDS_LANES_TARGETS]] void snapshot_positive(
    const Snapshot<Dimension>& snapshot,
    const typename LanesView<Snapshot<Dimension>, bead_arity<Function>>::Tuples& tuples, const Lanes& sides,
    Lanes::Mask& positive) {
  ScaledLanes<0> lanes;
  detail::evaluate_in_line<Function>(snapshot, tuples, sides, detail::bound_at_rest<Function, Dimension>,
                                     lanes);
  positive = lanes.positive;
}

}  // namespace kds
