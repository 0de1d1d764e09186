#include "kds/failure_order.h"

#include <tuple>

#include "certificates/exact/exact_time.h"
#include "certificates/exact/exact_work.h"

namespace kds {

int FailureOrder::compare_times(ScheduledFailure& a, ScheduledFailure& b) {
  bool one_function = false;
  return compare(a, b, one_function);
}

int FailureOrder::compare(ScheduledFailure& a, ScheduledFailure& b, bool& one_function) {
  if (a.time.upper < b.time.lower) return -1;
  if (b.time.upper < a.time.lower) return 1;
  if (a.tie != 0 && a.tie == b.tie) return 0;
  const bool point_a = a.time.lower == a.time.upper;
  const bool point_b = b.time.lower == b.time.upper;
  if (point_a && point_b) return 0;
  // If lower < upper, neither end of the bracket is the time itself.
  if (a.time.upper == b.time.lower) return -1;
  if (b.time.upper == a.time.lower) return 1;
  if (a.source->identity(a.slot) == b.source->identity(b.slot) &&
      a.source->side(a.slot) == b.source->side(b.slot) && !a.time.touch && !b.time.touch) {
    // Each certificate holds until it fails, so the two certificates wait for the next descent of the same
    // function. (After a touch, a certificate may already wait for the next root of the same function.)
    ++counts_.by_identity;
    one_function = true;
    return 0;
  }
  ++counts_.exact;
  const ExactWork::About about(a);
  ExactTime exact_a = exact_time(*a.source->exact_function(a.slot), a.time);
  ExactTime exact_b = exact_time(*b.source->exact_function(b.slot), b.time);
  const int order = ExactTime::compare(exact_a, exact_b);
  narrow(a.time, exact_a);
  narrow(b.time, exact_b);
  if (order == 0) {
    ++counts_.ties;
    if (a.tie == 0 && b.tie == 0)
      a.tie = b.tie = next_tie_++;
    else if (a.tie == 0)
      a.tie = b.tie;
    else if (b.tie == 0)
      b.tie = a.tie;
  }
  return order;
}

bool FailureOrder::before_closely(ScheduledFailure& a, ScheduledFailure& b) {
  bool one_function = false;
  if (const int order = compare(a, b, one_function)) return order < 0;
  // The facets of one event meet in the queue: about half of the close comparisons are between two of them.
  if (one_function) return a.source->place(a.slot) < b.source->place(b.slot);
  const auto key = [](const ScheduledFailure& f) {
    return std::tuple(f.source->identity(f.slot), f.source->place(f.slot));
  };
  return key(a) < key(b);
}

}  // namespace kds
