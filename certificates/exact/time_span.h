#pragma once
// Spans between two exact times, which may lie in different steps, compared with a length. Exact.

#include "certificates/exact/exact_time.h"
#include "motions/numbers/exact_number.h"

namespace kds {

/// A clock's readings at the ends of a step, begin < end. Within the step the clock runs evenly: its reading
/// at u is begin + u (end - begin), exactly. The unit is that of the readings, such as frames or picoseconds.
struct StepClock {
  double begin = 0, end = 1;

  /// Returns the reading at u, rounded.
  [[nodiscard]] double at(double u) const { return begin + u * (end - begin); }
};

/// Returns the sign of (later - earlier) - length, where both times are read on the clock of their steps.
/// Exact. Narrows both times. A comparison that brackets decide costs a few rational operations; equality
/// costs a gcd of the two polynomials.
[[nodiscard]] int compare_span(ExactTime& earlier, const StepClock& earlier_clock, ExactTime& later,
                               const StepClock& later_clock, double length);

/// Returns the sign of time - point. Narrows the time to that side of `point`.
[[nodiscard]] int compare_with(ExactTime& time, const Rational& point);

}  // namespace kds
