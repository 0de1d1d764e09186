#pragma once
// The failure-time cascade: from a certificate and the present time to its first failure in this step.
// `Filtered` and `Exact` answer exactly; `Fast` approximately (kernel.h).

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <optional>
#include <span>
#include <utility>

#include "certificates/base/certificate.h"
#include "certificates/base/failure_time.h"
#include "certificates/base/kernel.h"
#include "certificates/base/stage_counts.h"
#include "certificates/exact/exact_function.h"
#include "certificates/exact/instant.h"
#include "certificates/search/bounded_polynomial.h"
#include "certificates/search/classify_lanes.h"
#include "certificates/search/error_bound.h"
#include "certificates/search/moment_lanes.h"

namespace kds {

/// What the structure knows of a new certificate's function at the present time.
enum class KnownAtStart {
  unknown,
  /// The present time is a failure time of the same function (by Identity) with the opposite sign: the
  /// function has a root right now and is positive just after. After a flip the same beads give the negated
  /// polynomial.
  at_own_root,
};

/// The exact failure, a root of `function`, as a bracket in doubles.
[[nodiscard]] Failure to_failure(const ExactPolynomial& function, ExactFailure& root);

/// The exact stage alone.
[[nodiscard]] Failure exact_first_failure(const ExactPolynomial& function, const Instant& now,
                                          StageCounts& stages, TouchPolicy touches = TouchPolicy::ignored);

namespace detail {

/// A certificate's function in double with its errors, and whether all its coefficients are certainly
/// positive.
template <int Degree>
struct Bounded {
  BoundedPolynomial<Degree> function;
  bool positive;
};

template <int Degree>
void finish(Bounded<Degree>& bounded, double uniform_error) {
  double largest = 0;
  for (const double c : bounded.function.bernstein) largest = std::max(largest, std::abs(c));
  // Roundings are relative down to here only.
  if (largest < 0x1p-900) uniform_error = std::nan("");
  bounded.function.value_error = uniform_error + value_rounding(Degree) * largest;
  bounded.function.local_error = uniform_error + local_rounding(Degree) * largest;
}

/// By the certificate type's own filter.
template <class Certificate, Motion M>
[[nodiscard, gnu::noinline]] auto bounded_function(const Certificate& certificate, const M& motion) {
  const DoubleView<M> view(motion);
  const auto function = function_of(certificate, view);
  constexpr int degree = decltype(function)::degree;
  const auto& bound = error_bound<Certificate, M>;
  const double scale = bound.scale(view.largest_length());
  Bounded<degree> result{{{}, 0, 0}, true};
  for (std::size_t k = 0; k <= degree; ++k) {
    result.positive &= function.scaled[k] > bound.coefficient[k] * scale;
    result.function.bernstein[k] =
        function.scaled[k] / static_cast<double>(binomial(degree, static_cast<int>(k)));
  }
  finish(result, bound.uniform * scale);
  return result;
}

/// With errors followed operation by operation.
template <class Certificate, Motion M>
[[nodiscard, gnu::noinline]] auto tracked_function(const Certificate& certificate, const M& motion) {
  const auto function =
      function_of(certificate, TrackedView<M, channels_of<Certificate>>(motion, certificate.beads));
  constexpr int degree = decltype(function)::degree;
  Bounded<degree> result{{{}, 0, 0}, true};
  double uniform = 0;
  for (std::size_t k = 0; k <= degree; ++k) {
    const auto choose = static_cast<double>(binomial(degree, static_cast<int>(k)));
    const TrackedDouble& c = function.scaled[k];
    // One more rounding for the division; a NaN is kept, and proves nothing.
    const double error =
        (c.error + TrackedDouble::unit_roundoff * std::abs(c.value)) * TrackedDouble::inflation +
        TrackedDouble::lost_to_underflow;
    result.positive &= c.value > error;
    result.function.bernstein[k] = c.value / choose;
    uniform = error <= uniform || std::isnan(uniform) ? uniform : error;
  }
  finish(result, uniform);
  return result;
}

/// Does not hold just after now, as a sign certain all around now tells.
[[nodiscard]] inline Failure failed_at_birth(const Instant& now) {
  return {Failure::Kind::at_birth, {now.lower(), now.upper(), 0, false}};
}

/// Settles a certificate in double, or nothing.
template <int Degree>
[[nodiscard]] std::optional<Failure> settle(const Bounded<Degree>& bounded, const Instant& now,
                                            KnownAtStart birth) {
  if (bounded.positive) return Failure{};
  const BoundedPolynomial<Degree>& function = bounded.function;
  // At its own root the bracket holds no other one, and at its upper end the function is positive.
  const bool known = birth == KnownAtStart::at_own_root && now.isolating();
  if (!known) {
    const int sign =
        birth == KnownAtStart::at_own_root ? 0 : function.certain_sign_on(now.lower(), now.upper());
    if (sign == 0) return std::nullopt;
    if (sign < 0) return failed_at_birth(now);
  }
  const auto result = function.first_descent(now.upper(), known);
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

template <class Certificate, Motion M>
[[nodiscard]] Failure fast_first_failure(const Certificate& certificate, const M& motion, const Instant& now,
                                         KnownAtStart birth, StageCounts& stages) {
  auto function = bounded_function(certificate, motion).function;
  function.value_error = function.local_error = 0;
  for (const double c : function.bernstein) {
    if (!std::isfinite(c)) return {};  // nothing can be said; the structure's frame check will see to it
  }
  double from = now.upper();
  if (birth == KnownAtStart::at_own_root) {
    // Leave the root behind: the smallest step that makes the value positive, or give the certificate up.
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

/// The stages after the certificate type's own filter.
template <class Certificate, Motion M>
[[nodiscard]] Failure careful_first_failure(const Certificate& certificate, const M& motion,
                                            const Instant& now, KnownAtStart birth, StageCounts& stages,
                                            TouchPolicy touches) {
  const auto tracked = tracked_function(certificate, motion);
  auto failure = settle(tracked, now, birth);
  // Next to a double root the present bracket is wide, and what fails soon after lies in its shadow.
  if (!failure && now.narrow()) failure = settle(tracked, now, birth);
  if (failure) {
    ++stages.refined;
    return *failure;
  }
  // Whatever touches zero comes here: doubles prove signs, and a zero has none.
  return exact_first_failure(exact_function(certificate, motion), now, stages, touches);
}

/// Beads lie anywhere in memory: those of the next certificates are fetched while these are worked on.
template <class Certificate, Motion M>
void fetch_early(const Certificate& certificate, const M& motion) {
  for (const BeadId bead : certificate.beads) __builtin_prefetch(motion.control_point(bead, 0));
}

/// Up to four certificates side by side, named by their places; the last one fills what is left.
template <Motion M, class Certificate>
[[nodiscard]] auto in_lanes(std::span<const Certificate> certificates, std::span<const std::size_t> places) {
  constexpr std::array<double, 2> signs{-1, 1};  // no branch: no one foretells a side
  std::pair<typename LanesView<M, bead_places<Certificate>>::Tuples, Lanes> lanes;
  for (std::size_t lane = 0; lane < Lanes::width; ++lane) {
    const Certificate& certificate = certificates[places[std::min(lane, places.size() - 1)]];
    lanes.first[lane] = certificate.beads;
    lanes.second.v[lane] = signs[certificate.side() ? 1 : 0];
  }
  return lanes;
}

/// Up to four certificates at once, named by their places.
template <class Certificate, Motion M>
void filtered_first_failures(std::span<const Certificate> certificates, std::span<const std::size_t> places,
                             const M& motion, const Instant& now, std::span<const KnownAtStart> births,
                             StageCounts& stages, TouchPolicy touches, std::span<Failure> failures) {
  constexpr int degree = decltype(function_of(Certificate{}, DoubleView<M>(motion)))::degree;
  const auto [tuples, sides] = in_lanes<M>(certificates, places);
  LanesNow lanes_now{now.lower(), now.upper(), now.isolating(), 0};
  for (std::size_t lane = 0; lane < places.size(); ++lane) {
    if (births[places[lane]] == KnownAtStart::at_own_root) lanes_now.at_own_root |= 1U << lane;
  }
  LanesOutcome<degree> outcome;
  classify_lanes<Certificate>(motion, tuples, sides, lanes_now, outcome);
  if (Lanes::all(outcome.positive)) {
    for (const std::size_t place : places) failures[place] = {};
    stages.coefficients += places.size();
    return;
  }
  LanesDescent<degree>& descent = outcome.descent;
  LanesSearch search{outcome.positive | outcome.never, outcome.found, outcome.found};
  if (Lanes::any(outcome.unclear))
    isolate_lanes(descent, now.upper(), outcome.unclear, outcome.known, search);
  if (Lanes::any(search.found)) narrow_lanes(descent, search.found);
  for (std::size_t lane = 0; lane < places.size(); ++lane) {
    const std::size_t place = places[lane];
    if (search.never[lane] != 0) {
      ++(outcome.positive[lane] != 0 ? stages.coefficients : stages.isolation);
      failures[place] = {};
    } else if (search.found[lane] != 0) {
      ++stages.isolation;
      failures[place] = {
          Failure::Kind::later,
          {descent.lower.v[lane], descent.upper.v[lane], 0, true, false, search.last[lane] != 0}};
    } else if (outcome.violated[lane] != 0) {
      ++stages.isolation;
      failures[place] = failed_at_birth(now);
    } else {
      failures[place] =
          careful_first_failure(certificates[place], motion, now, births[place], stages, touches);
    }
  }
}

}  // namespace detail

/// When each of these certificates, born now, fails for the first time in the motion's step. All that are
/// born at their own root have one function, the one that is zero now: it is searched once.
template <Kernel K, class Certificate, Motion M>
requires CertificateFor<Certificate, M>
void first_failures(std::span<const Certificate> certificates, const M& motion, const Instant& now,
                    std::span<const KnownAtStart> births, StageCounts& stages, TouchPolicy touches,
                    std::span<Failure> failures) {
  constexpr std::size_t at_once = std::same_as<K, Filtered> ? Lanes::width : 1;
  std::array<std::size_t, at_once> places{};
  std::size_t count = 0;
  const auto search = [&] {
    if constexpr (std::same_as<K, Filtered>) {
      detail::filtered_first_failures(certificates, std::span<const std::size_t>(places).first(count), motion,
                                      now, births, stages, touches, failures);
    } else {
      const Certificate& certificate = certificates[places[0]];
      failures[places[0]] =
          std::same_as<K, Fast>
              ? detail::fast_first_failure(certificate, motion, now, births[places[0]], stages)
              : exact_first_failure(exact_function(certificate, motion), now, stages, touches);
    }
    count = 0;
  };
  std::optional<std::size_t> at_own_root;
  for (std::size_t i = 0; i < certificates.size(); ++i) {
    if (i + at_once < certificates.size()) detail::fetch_early(certificates[i + at_once], motion);
    if (births[i] == KnownAtStart::at_own_root) {
      if (at_own_root) continue;
      at_own_root = i;
      if (std::same_as<K, Filtered> && now.last()) {  // it has none after that
        failures[i] = {};
        ++stages.isolation;
        continue;
      }
    }
    places[count++] = i;
    if (count == at_once) search();
  }
  if (count > 0) search();
  for (std::size_t i = at_own_root.value_or(certificates.size()) + 1; i < certificates.size(); ++i) {
    if (births[i] != KnownAtStart::at_own_root) continue;
    failures[i] = failures[*at_own_root];
    ++stages.shared;
  }
}

/// When `certificate`, of whatever kind has a search of its own, born now, fails for the first time in the
/// motion's step.
template <Kernel K, class Certificate, Motion M>
[[nodiscard]] Failure first_failure(const Certificate& certificate, const M& motion, const Instant& now,
                                    KnownAtStart birth, StageCounts& stages,
                                    TouchPolicy touches = TouchPolicy::ignored) {
  Failure failure;
  first_failures<K>(std::span(&certificate, 1), motion, now, std::span(&birth, 1), stages, touches,
                    std::span(&failure, 1));
  return failure;
}

namespace detail {

/// A sign that doubles find alike all around now, else the one that `exact_sign` finds in integers.
template <Kernel K, class Function, Motion M>
requires FunctionOfBeads<Function, M>
[[nodiscard]] int sign_around(const Function& function, const M& motion, const Instant& now,
                              StageCounts& stages, int (*exact_sign)(const ExactPolynomial&, ExactTime&)) {
  if constexpr (std::same_as<K, Fast>) {
    const double value = bounded_function(function, motion).function.value_at(now.upper());
    return value > 0 ? 1 : value < 0 ? -1 : 0;
  }
  if constexpr (std::same_as<K, Filtered>) {
    const auto sign_of = [&now](const auto& bounded) {
      return bounded.function.certain_sign_on(now.lower(), now.upper());
    };
    int sign = sign_of(bounded_function(function, motion));
    if (sign == 0) sign = sign_of(tracked_function(function, motion));
    if (sign != 0) {
      ++stages.signs_double;
      return sign;
    }
  }
  const ExactPolynomial exact = exact_function(function, motion);
  ++stages.signs_exact;
  stages.largest_bits = std::max<std::uint64_t>(stages.largest_bits, exact.largest_bit_length());
  return exact_sign(exact, now.exact());
}

}  // namespace detail

/// The sign of a function of beads now: 1, 0 or -1.
template <Kernel K, class Function, Motion M>
[[nodiscard]] int sign_now(const Function& function, const M& motion, const Instant& now,
                           StageCounts& stages) {
  return detail::sign_around<K>(function, motion, now, stages, sign_at);
}

/// The sign just after now: 1, -1, or 0 if the function is zero for the whole step.
template <Kernel K, class Function, Motion M>
[[nodiscard]] int sign_just_after(const Function& function, const M& motion, const Instant& now,
                                  StageCounts& stages) {
  return detail::sign_around<K>(function, motion, now, stages, sign_after);
}

/// Whether all functions are positive now. In doubles, four at once, where that will do.
template <Kernel K, class Function, Motion M>
[[nodiscard]] bool all_positive_now(std::span<const Function> functions, const M& motion, const Instant& now,
                                    StageCounts& stages) {
  constexpr std::array<std::size_t, Lanes::width> places{0, 1, 2, 3};
  for (std::size_t i = 0; i < functions.size(); i += Lanes::width) {
    const auto some = functions.subspan(i, std::min(Lanes::width, functions.size() - i));
    if constexpr (std::same_as<K, Filtered>) {
      bool all_positive = false;
      const auto [tuples, sides] =
          detail::in_lanes<M>(some, std::span<const std::size_t>(places).first(some.size()));
      positive_at_moment<Function>(motion, tuples, sides, now.lower(), now.upper(), all_positive);
      if (all_positive) {
        stages.signs_double += some.size();
        continue;
      }
    }
    for (const Function& f : some) {
      if (sign_now<K>(f, motion, now, stages) <= 0) return false;
    }
  }
  return true;
}

}  // namespace kds
