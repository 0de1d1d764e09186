#include "certificates/search/exact_search.h"

#include <algorithm>
#include <optional>

#include "certificates/exact/rounded_polynomial.h"

namespace kds {

namespace {

/// Returns the failure that doubles prove, or nothing. Never misses a touch: doubles cannot prove a double
/// root away.
std::optional<Failure> proved_failure(const RoundedPolynomial& function, const Instant& now,
                                      KnownAtStart known) {
  if (known == KnownAtStart::at_own_root) {
    if (!now.isolating()) return std::nullopt;  // if isolating, it is positive at the upper end
  } else {
    const int sign = function.sign_on(now.lower(), now.upper());
    if (sign == 0) return std::nullopt;
    if (sign < 0) return failed_at_birth(now);
  }
  const auto [verdict, descent] = function.first_descent(now.upper());
  if (verdict == RoundedPolynomial::Verdict::undecided) return std::nullopt;
  if (verdict == RoundedPolynomial::Verdict::never) return Failure{};
  return Failure{Failure::Kind::later, {descent.lower, descent.upper, 0, true, false, descent.last}};
}

}  // namespace

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

  // Doubles are too coarse to isolate the root, so find its ordinal among the roots in the widened bracket.
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
  return decided(to_failure(function, *root), DecidedBy::exact);
}

Failure rounded_first_failure(const ExactPolynomial& function, const Instant& now, KnownAtStart known,
                              StageCounts& stages, TouchPolicy touches) {
  if (function.wide() == nullptr && !function.is_zero()) {
    if (const auto failure = proved_failure(RoundedPolynomial(function), now, known)) {
      ++stages.exact;
      stages.largest_bits = std::max<std::uint64_t>(stages.largest_bits, function.largest_bit_length());
      return decided(*failure, DecidedBy::exact);
    }
  }
  return exact_first_failure(function, now, stages, touches);
}

int rounded_sign(const ExactPolynomial& function, const Instant& now,
                 int (*exact_sign)(const ExactPolynomial&, ExactTime&)) {
  if (function.wide() == nullptr && now.lower() > 0 && now.upper() < 1) {  // roots at 0 and 1 are divided out
    if (const int sign = RoundedPolynomial(function).sign_on(now.lower(), now.upper())) return sign;
  }
  return exact_sign(function, now.exact());
}

}  // namespace kds
