#include "certificates/search/careful_search.h"

#include <algorithm>
#include <cmath>

namespace kds {

std::optional<Failure> proved_failure(const BoundedFunction& bounded, const Instant& now,
                                      KnownAtStart known) {
  if (bounded.positive) return Failure{};
  const BoundedPolynomial& function = bounded.polynomial;
  // At its own root, the function has no other root in the bracket and is positive at the upper end.
  const bool positive = known == KnownAtStart::at_own_root && now.isolating();
  if (!positive) {
    const int sign =
        known == KnownAtStart::at_own_root ? 0 : function.certain_sign_on(now.lower(), now.upper());
    if (sign == 0) return std::nullopt;
    if (sign < 0) return failed_at_birth(now);
  }
  const auto result = function.first_descent(now.upper(), positive);
  switch (result.verdict) {
    case Verdict::never:
      return Failure{};
    case Verdict::found:
      return Failure{Failure::Kind::later, {result.bracket.lower, result.bracket.upper, 0, true}};
    case Verdict::undecided:
      break;
  }
  return std::nullopt;
}

Failure fast_first_failure(BoundedPolynomial function, const Instant& now, KnownAtStart known,
                           StageCounts& stages) {
  function.value_error = function.local_error = 0;
  for (const double c : function.bernstein) {
    if (!std::isfinite(c)) return {};  // undecidable; the structure's check of frames reports the input
  }
  double from = now.upper();
  if (known == KnownAtStart::at_own_root) {
    // Step past the root: take the smallest step that makes the value positive, or give the certificate up.
    double step = 0x1p-50;
    while (from + step < 1 && !(function.value_at(from + step) > 0) && step < 0x1p-20) step *= 4;
    from += step;
    if (!(from < 1) || !(function.value_at(from) > 0)) return {};
  } else if (!(function.value_at(from) > 0)) {
    const double ahead = function.value_at(std::min(1.0, from + 0x1p-20));
    if (ahead < 0) return {Failure::Kind::at_birth, {from, from, 0, false}};
    if (!(ahead > 0)) return {};
    from = std::min(1.0, from + 0x1p-20);
  }
  const auto result = function.first_descent(from);
  if (result.verdict != Verdict::found) {
    ++stages.coefficients;
    return {};
  }
  ++stages.isolation;
  const double time = 0.5 * (result.bracket.lower + result.bracket.upper);
  return {Failure::Kind::later, {time, time, 0, false}};
}

}  // namespace kds
