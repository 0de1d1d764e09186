#pragma once
// The failure-time cascade for radical certificates (radical.h): the same questions, answers and stages as in
// failure_search.h. Candidates for a failure are all distinct roots of the norm, also where it does not
// change sign; each is judged by the sign of the function just after it. Where the norm is the zero
// polynomial, they are those of A and of B. `Filtered` and `Exact` answer exactly, `Fast` approximately.

#include <algorithm>
#include <cmath>
#include <concepts>
#include <optional>
#include <span>
#include <utility>

#include "certificates/search/failure_search.h"
#include "certificates/search/radical_in_double.h"

namespace kds {

/// A + B sqrt(D) by its three polynomials, on integers.
struct ExactRadical {
  ExactPolynomial rational, root, norm;

  /// By `sign_of` (sign_at or sign_after) of the polynomials.
  [[nodiscard]] int sign(ExactTime& time, int (*sign_of)(const ExactPolynomial&, ExactTime&)) const;
};

/// A radical certificate on integers.
struct ExactRadicalCertificate {
  ExactRadical radical;
  std::optional<ExactRadical> condition;
  bool side = true;

  [[nodiscard]] int sign(ExactTime& time, int (*sign_of)(const ExactPolynomial&, ExactTime&)) const;
  /// Zero at a candidate and positive on both sides, where it is positive just after.
  [[nodiscard]] bool touches(ExactTime& candidate) const;
  /// Has all roots of the certificate's function: the norm, or, where that is zero, A B.
  [[nodiscard]] ExactPolynomial candidates() const;
  [[nodiscard]] std::size_t largest_bit_length() const;
};

/// The exact stage alone.
[[nodiscard]] Failure exact_first_failure(const ExactRadicalCertificate& certificate, const Instant& now,
                                          StageCounts& stages, TouchPolicy touches = TouchPolicy::ignored);

namespace detail {

template <class Radical, class Certificate, Motion M>
[[nodiscard]] ExactRadical exact_radical(const Certificate& certificate, const M& motion, int root_sign) {
  return {exact_function(part_of<typename Radical::Rational>(certificate), motion),
          exact_function(part_of<typename Radical::Root>(certificate, root_sign), motion),
          exact_function(part_of<typename Radical::Norm>(certificate), motion)};
}

template <class Certificate, Motion M>
[[nodiscard]] ExactRadicalCertificate exact_certificate(const Certificate& certificate, const M& motion) {
  ExactRadicalCertificate exact{
      exact_radical<typename Certificate::Radical>(certificate, motion, certificate.root_sign()),
      {},
      certificate.side()};
  if constexpr (ConditionalFor<Certificate, M>) {
    if (certificate.conditional(motion))
      exact.condition = exact_radical<typename Certificate::Condition>(certificate, motion, 1);
  }
  return exact;
}

template <class Certificate, Motion M>
[[nodiscard]] Failure filtered_first_failure(const Certificate& certificate, const M& motion,
                                             const Instant& now, KnownAtStart birth, StageCounts& stages,
                                             TouchPolicy touches) {
  if (const auto failure =
          classify_radical(CertificateInDouble<OwnFilter, Certificate, M>(certificate, motion), now, birth)) {
    ++stages.isolation;
    return *failure;
  }
  const CertificateInDouble<TrackedErrors, Certificate, M> tracked(certificate, motion);
  auto failure = classify_radical(tracked, now, birth);
  // As in careful_first_failure.
  if (!failure && now.narrow()) failure = classify_radical(tracked, now, birth);
  if (failure) {
    ++stages.refined;
    return *failure;
  }
  return exact_first_failure(exact_certificate(certificate, motion), now, stages, touches);
}

/// In plain doubles.
template <class Certificate, Motion M>
[[nodiscard]] Failure fast_first_failure(const Certificate& certificate, const M& motion, const Instant& now,
                                         KnownAtStart birth,
                                         StageCounts& stages) requires RadicalCertificateFor<Certificate, M> {
  const CertificateInDouble<NoErrors, Certificate, M> plain(certificate, motion);
  for (const double c : plain.norm().bernstein) {
    if (!std::isfinite(c)) return {};  // nothing can be said
  }
  const auto sign_at = [&](double u) { return plain.certain_sign_on(u, u); };
  double from = now.upper();
  if (birth == KnownAtStart::at_own_root || sign_at(from) == 0) {
    // Leave the root behind: the smallest step that makes the sign certain, or give the certificate up.
    double step = 0x1p-50;
    while (from + step < 1 && sign_at(from + step) <= 0 && step < 0x1p-20) step *= 4;
    from += step;
    if (!(from < 1)) return {};
    if (birth == KnownAtStart::at_own_root && sign_at(from) <= 0) return {};
  }
  if (sign_at(from) < 0) return {Failure::Kind::at_birth, {now.upper(), now.upper(), 0, false}};
  const auto failure = walk_candidates(plain, from);
  if (!failure || failure->kind != Failure::Kind::later) {
    ++stages.coefficients;
    return {};
  }
  ++stages.isolation;
  const double time = 0.5 * (failure->time.lower + failure->time.upper);
  return {Failure::Kind::later, {time, time, 0, false}};
}

}  // namespace detail

/// The polynomial whose roots failure times of `certificate` name.
template <class Certificate, Motion M>
requires RadicalCertificateFor<Certificate, M>
[[nodiscard]] ExactPolynomial exact_function(const Certificate& certificate, const M& motion) {
  return detail::exact_certificate(certificate, motion).candidates();
}

/// When each of these certificates, born now, fails for the first time in the motion's step.
template <Kernel K, class Certificate, Motion M>
requires RadicalCertificateFor<Certificate, M>
void first_failures(std::span<const Certificate> certificates, const M& motion, const Instant& now,
                    std::span<const KnownAtStart> births, StageCounts& stages, TouchPolicy touches,
                    std::span<Failure> failures) {
  for (std::size_t i = 0; i < certificates.size(); ++i) {
    const Certificate& certificate = certificates[i];
    if constexpr (std::same_as<K, Fast>) {
      failures[i] = detail::fast_first_failure(certificate, motion, now, births[i], stages);
    } else if constexpr (std::same_as<K, Filtered>) {
      failures[i] = detail::filtered_first_failure(certificate, motion, now, births[i], stages, touches);
    } else {
      failures[i] = exact_first_failure(detail::exact_certificate(certificate, motion), now, stages, touches);
    }
  }
}

namespace detail {

template <Kernel K, class Certificate, Motion M>
[[nodiscard]] int radical_sign_around(const Certificate& certificate, const M& motion, const Instant& now,
                                      StageCounts& stages,
                                      int (*exact_sign)(const ExactPolynomial&, ExactTime&)) {
  if constexpr (std::same_as<K, Fast>) {
    return CertificateInDouble<NoErrors, Certificate, M>(certificate, motion)
        .certain_sign_on(now.upper(), now.upper());
  }
  if constexpr (std::same_as<K, Filtered>) {
    const int sign = CertificateInDouble<TrackedErrors, Certificate, M>(certificate, motion)
                         .certain_sign_on(now.lower(), now.upper());
    if (sign != 0) {
      ++stages.signs_double;
      return sign;
    }
  }
  const ExactRadicalCertificate exact = exact_certificate(certificate, motion);
  ++stages.signs_exact;
  stages.largest_bits = std::max<std::uint64_t>(stages.largest_bits, exact.largest_bit_length());
  return exact.sign(now.exact(), exact_sign);
}

}  // namespace detail

/// The sign of `certificate` just after `failed` has, of the same type and with the same norm, as doubles
/// know it, or 0. Up to there the basis must be one (ball_in_sphere.h).
template <class Certificate, Motion M>
requires RadicalCertificateFor<Certificate, M>
[[nodiscard]] int sign_after_failure(const Certificate& certificate, const Certificate& failed,
                                     const M& motion, const Instant& now, StageCounts& stages) {
  using InDouble = detail::CertificateInDouble<detail::TrackedErrors, Certificate, M>;
  if (!now.isolating()) return 0;
  const int norm = -InDouble(failed, motion).norm_while_it_holds(now.lower(), now.upper());
  const int sign = InDouble(certificate, motion).sign_by_norm(norm, now.lower(), now.upper());
  stages.signs_double += sign != 0 ? 1 : 0;
  return sign;
}

/// The sign of the certificate's function now: 1, 0 or -1.
template <Kernel K, class Certificate, Motion M>
requires RadicalCertificateFor<Certificate, M>
[[nodiscard]] int sign_now(const Certificate& certificate, const M& motion, const Instant& now,
                           StageCounts& stages) {
  return detail::radical_sign_around<K>(certificate, motion, now, stages, sign_at);
}

/// The sign just after now: 1, -1, or 0 if the function is zero from now on for a while.
template <Kernel K, class Certificate, Motion M>
requires RadicalCertificateFor<Certificate, M>
[[nodiscard]] int sign_just_after(const Certificate& certificate, const M& motion, const Instant& now,
                                  StageCounts& stages) {
  return detail::radical_sign_around<K>(certificate, motion, now, stages, sign_after);
}

}  // namespace kds
