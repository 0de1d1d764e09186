#include "certificates/search/exact_search.h"

#include <algorithm>

namespace kds {

Failure to_failure(const ExactPolynomial& function, ExactFailure& failure) {
  ExactTime& root = failure.time;
  const bool touch = failure.touch;
  const Dyadic before = root.lower();
  const Dyadic after = root.upper();
  root.narrow_for_doubles();
  const double lower = root.lower().round_down();
  const double upper = root.upper().round_up();
  if (lower == upper) return {Failure::Kind::later, {lower, upper, 0, false, touch}};

  const Dyadic from(lower);
  const Dyadic to(upper);
  const auto proved = [&] { return function.sign_at(from) * function.sign_at(to) < 0; };
  if (before <= from && to <= after && proved())
    return {Failure::Kind::later, {lower, upper, 0, true, touch}};

  // Doubles are too coarse to isolate it: which of the roots in the widened bracket is it?
  const ExactPolynomial simple = function.square_free();
  auto roots = isolate_roots(simple, from, to);
  const bool isolating = roots.size() == 1 && proved();
  std::uint16_t ordinal = 0;
  for (RootInterval& interval : roots) {
    ExactTime candidate(simple, std::move(interval));
    if (ExactTime::compare(candidate, root) == 0) break;
    ++ordinal;
  }
  return {Failure::Kind::later, {lower, upper, ordinal, isolating, touch}};
}

Failure exact_first_failure(const ExactPolynomial& function, const Instant& now, StageCounts& stages,
                            TouchPolicy touches) {
  if (function.is_zero()) {
    ++stages.identically_zero;
    return {Failure::Kind::zero, {}};
  }
  ++stages.exact;
  stages.largest_bits = std::max<std::uint64_t>(stages.largest_bits, function.largest_bit_length());
  ExactTime& time = now.exact();
  if (sign_after(function, time) < 0) return {Failure::Kind::at_birth, {now.lower(), now.upper(), 0, false}};
  std::optional<ExactFailure> root = first_failure_after(function, time, touches);
  if (!root) return {};
  return to_failure(function, *root);
}

}  // namespace kds
