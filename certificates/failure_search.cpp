#include "certificates/failure_search.h"

namespace kds {

Failure to_failure(const ExactPolynomial& function, ExactTime& root) {
  root.refine_to(44);
  const double lower = root.lower().round_down();
  const double upper = root.upper().round_up();
  if (lower == upper) return {Failure::Kind::later, {lower, upper, 0, false}};

  // Which of the roots in the widened bracket is it?
  const Dyadic from(lower);
  const Dyadic to(upper);
  const ExactPolynomial simple = function.square_free();
  auto roots = isolate_roots(simple, from, to);
  std::uint16_t ordinal = 0;
  for (RootInterval& interval : roots) {
    ExactTime candidate(simple, std::move(interval));
    if (ExactTime::compare(candidate, root) == 0) break;
    ++ordinal;
  }
  const bool isolating = roots.size() == 1 && function.sign_at(from) > 0 && function.sign_at(to) < 0;
  return {Failure::Kind::later, {lower, upper, ordinal, isolating}};
}

Failure exact_first_failure(const ExactPolynomial& function, const Instant& now, StageCounts& stages) {
  if (function.is_zero()) {
    ++stages.identically_zero;
    return {};
  }
  ++stages.exact;
  stages.largest_bits = std::max<std::uint64_t>(stages.largest_bits, function.largest_bit_length());
  ExactTime& time = now.exact();
  if (sign_after(function, time) < 0) return {Failure::Kind::at_birth, {now.lower(), now.upper(), 0, false}};
  std::optional<ExactTime> root = first_failure_after(function, time);
  if (!root) return {};
  return to_failure(function, *root);
}

}  // namespace kds
