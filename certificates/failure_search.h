#pragma once
// The failure-time cascade: from a certificate and the present time to its first failure in this step.
// `Filtered` and `Exact` answer exactly; `Fast` approximately (kernel.h).

#include <algorithm>
#include <cmath>
#include <limits>

#include "certificates/bounded_polynomial.h"
#include "certificates/certificate.h"
#include "certificates/error_bound.h"
#include "certificates/failure_time.h"
#include "certificates/instant.h"
#include "certificates/kernel.h"
#include "certificates/stage_counts.h"

namespace kds {

/// What the structure knows of a new certificate's function at the present time.
enum class Birth {
  unknown,
  /// The present time is a failure time of the same function (by Identity) with the opposite sign: the
  /// function has a root right now and is positive just after. After a flip the same beads give the negated
  /// polynomial.
  at_own_root,
};

// Rarely called and large: one copy for all kernels.
template <class Certificate, Motion M>
[[nodiscard, gnu::noinline]] ExactPolynomial exact_function(const Certificate& certificate, const M& motion) {
  return ExactPolynomial(certificate.function(IntegerView<M>(motion, certificate.beads)));
}

/// The exact failure as a bracket in doubles.
[[nodiscard]] Failure to_failure(const ExactPolynomial& function, ExactTime& root);

/// The exact stage alone.
[[nodiscard]] Failure exact_first_failure(const ExactPolynomial& function, const Instant& now,
                                          StageCounts& stages);

namespace detail {

template <class Certificate, Motion M>
[[nodiscard, gnu::noinline]] auto bounded_function(const Certificate& certificate, const M& motion) {
  const DoubleView<M> view(motion);
  const auto function = certificate.function(view);
  constexpr int degree = decltype(function)::degree;
  const auto& bound = error_bound<Certificate, M>;
  const double scale = bound.scale(view.largest_length());
  BoundedPolynomial<degree> result{{}, bound.value * scale, bound.local * scale};
  bool positive = true;
  for (std::size_t k = 0; k <= degree; ++k) {
    positive &= function.scaled[k] > bound.coefficient[k] * scale;
    result.bernstein[k] = function.scaled[k] / static_cast<double>(binomial(degree, static_cast<int>(k)));
  }
  return std::pair(result, positive);
}

template <class Certificate, Motion M>
[[nodiscard]] Failure fast_first_failure(const Certificate& certificate, const M& motion, const Instant& now,
                                         Birth birth, StageCounts& stages) {
  auto [function, positive] = bounded_function(certificate, motion);
  function.value_error = function.local_error = 0;
  for (const double c : function.bernstein) {
    if (!std::isfinite(c)) return {};  // nothing can be said; the structure's frame check will see to it
  }
  double from = now.upper();
  if (birth == Birth::at_own_root) {
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

}  // namespace detail

/// When `certificate`, born now, fails for the first time in the motion's step.
template <Kernel K, class Certificate, Motion M>
requires CertificateFor<Certificate, M>
[[nodiscard]] Failure first_failure(const Certificate& certificate, const M& motion, const Instant& now,
                                    Birth birth, StageCounts& stages) {
  if constexpr (std::same_as<K, Fast>) {
    return detail::fast_first_failure(certificate, motion, now, birth, stages);
  } else {
    if constexpr (std::same_as<K, Filtered>) {
      const auto [function, positive] = detail::bounded_function(certificate, motion);
      if (positive) {
        ++stages.coefficients;
        return {};
      }
      // Positive from the present time on? At its own root the bracket holds no other one, and its upper end
      // tells.
      const bool starts_positive = birth == Birth::at_own_root
                                       ? now.isolating() && function.certain_sign_at(now.upper()) > 0
                                       : function.certain_sign_on(now.lower(), now.upper()) > 0;
      if (starts_positive) {
        const auto result = function.first_descent(now.upper());
        if (result.verdict != Verdict::undecided) ++stages.isolation;
        if (result.verdict == Verdict::never) return {};
        if (result.verdict == Verdict::found) {
          return {Failure::Kind::later, {result.bracket.lower, result.bracket.upper, 0, true}};
        }
      }
    }
    return exact_first_failure(exact_function(certificate, motion), now, stages);
  }
}

/// The sign of the certificate's function just after now: 1, -1, or 0 if it is zero for the whole step.
template <Kernel K, class Certificate, Motion M>
requires CertificateFor<Certificate, M>
[[nodiscard]] int sign_just_after(const Certificate& certificate, const M& motion, const Instant& now,
                                  StageCounts& stages) {
  if constexpr (!std::same_as<K, Exact>) {
    const auto [function, positive] = detail::bounded_function(certificate, motion);
    if constexpr (std::same_as<K, Fast>) {
      const double value = function.value_at(now.upper());
      return value > 0 ? 1 : value < 0 ? -1 : 0;
    } else {
      if (const int sign = function.certain_sign_on(now.lower(), now.upper())) {
        ++stages.signs_double;
        return sign;
      }
    }
  }
  const ExactPolynomial function = exact_function(certificate, motion);
  ++stages.signs_exact;
  stages.largest_bits = std::max<std::uint64_t>(stages.largest_bits, function.largest_bit_length());
  return sign_after(function, now.exact());
}

}  // namespace kds
