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

#include "certificates/failure_search.h"
#include "certificates/radical.h"

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
                                          StageCounts& stages, Touches touches = Touches::ignored);

namespace detail {

/// One polynomial of a radical, or its negative.
template <class Polynomial>
struct SignedPart {
  static constexpr bool uses_weights = channels_of<Polynomial>.weights;
  static constexpr bool uses_radii = channels_of<Polynomial>.radii;

  decltype(Polynomial{}.beads) beads{};
  int sign = 1;

  [[nodiscard]] bool side() const { return sign > 0; }
  template <MotionView View>
  [[nodiscard]] static auto formula(const View& view, const decltype(Polynomial{}.beads) & of) {
    return Polynomial::formula(view, of);
  }
};

template <class Polynomial, class Certificate>
[[nodiscard]] SignedPart<Polynomial> part_of(const Certificate& certificate, int sign = 1) {
  return {certificate.beads, sign};
}

template <class Radical, class Certificate, Motion M>
[[nodiscard]] ExactRadical exact_radical(const Certificate& certificate, const M& motion, int root_sign) {
  return {exact_function(part_of<typename Radical::Rational>(certificate), motion),
          exact_function(part_of<typename Radical::Root>(certificate, root_sign), motion),
          exact_function(part_of<typename Radical::Norm>(certificate), motion)};
}

/// The certificate type's own filter, and errors followed operation by operation.
struct OwnFilter {
  template <class Part, Motion M>
  [[nodiscard]] static auto bounded(const Part& part, const M& motion) {
    return bounded_function(part, motion);
  }
};
struct TrackedErrors {
  template <class Part, Motion M>
  [[nodiscard]] static auto bounded(const Part& part, const M& motion) {
    return tracked_function(part, motion);
  }
};
/// Nothing certain, everything taken to be.
struct NoErrors {
  template <class Part, Motion M>
  [[nodiscard]] static auto bounded(const Part& part, const M& motion) {
    auto result = bounded_function(part, motion);
    result.function.value_error = result.function.local_error = 0;
    return result;
  }
};

/// A radical's polynomials in double with their errors; the norm, the longest by far, when it is asked for.
template <class Radical, class Errors, class Certificate, Motion M>
class RadicalInDouble {
 public:
  /// Times `sign`, and the root by `root_sign` too.
  RadicalInDouble(const Certificate& certificate, const M& motion, int sign, int root_sign)
      : certificate_(certificate),
        motion_(motion),
        rational_(Errors::bounded(part_of<typename Radical::Rational>(certificate, sign), motion)),
        root_(Errors::bounded(part_of<typename Radical::Root>(certificate, sign * root_sign), motion)) {}

  [[nodiscard]] const auto& norm() const {
    if (!norm_) norm_ = Errors::bounded(part_of<typename Radical::Norm>(certificate_), motion_);
    return norm_->function;
  }
  /// 1 or -1 if that is the sign all over [lower, upper] for certain, else 0.
  [[nodiscard]] int certain_sign_on(double lower, double upper) const {
    const int a = rational_.function.certain_sign_on(lower, upper);
    const int b = root_.function.certain_sign_on(lower, upper);
    return a == b ? a : sign_of_radical(a, b, norm().certain_sign_on(lower, upper));
  }
  /// The same where the norm's sign is known, or 0.
  [[nodiscard]] int sign_by_norm(int norm_sign, double lower, double upper) const {
    return sign_of_radical(rational_.function.certain_sign_on(lower, upper),
                           root_.function.certain_sign_on(lower, upper), norm_sign);
  }
  /// The sign of A, if B certainly has the other, all over [lower, upper], else 0. The norm has this sign
  /// where the radical is positive, and the other where that is negative.
  [[nodiscard]] int sign_against_root_on(double lower, double upper) const {
    const int a = rational_.function.certain_sign_on(lower, upper);
    return root_.function.certain_sign_on(lower, upper) == -a ? a : 0;
  }
  /// The same all over the step, by A and B alone.
  [[nodiscard]] bool certainly_positive() const { return rational_.positive && root_.positive; }

 private:
  template <class Polynomial>
  using InDouble = decltype(Errors::bounded(part_of<Polynomial>(std::declval<const Certificate&>()),
                                            std::declval<const M&>()));

  const Certificate& certificate_;
  const M& motion_;
  InDouble<typename Radical::Rational> rational_;
  InDouble<typename Radical::Root> root_;
  mutable std::optional<InDouble<typename Radical::Norm>> norm_;
};

/// A radical certificate in double.
template <class Errors, class Certificate, Motion M>
class CertificateInDouble {
 public:
  CertificateInDouble(const Certificate& certificate, const M& motion)
      : certificate_(certificate),
        motion_(motion),
        side_(certificate.side() ? 1 : -1),
        wanted_(certificate, motion, side_, certificate.root_sign()) {
    if constexpr (ConditionalFor<Certificate, M>) conditional_ = certificate.conditional(motion);
  }

  [[nodiscard]] const auto& norm() const { return wanted_.norm(); }
  /// 1 or -1 if that is the sign all over [lower, upper] for certain, else 0.
  [[nodiscard]] int certain_sign_on(double lower, double upper) const {
    return side_ * with_condition(side_ * wanted_.certain_sign_on(lower, upper), lower, upper);
  }
  /// The norm's sign where the certificate holds, as A and B of opposite signs all over [lower, upper] tell,
  /// else 0.
  [[nodiscard]] int norm_while_it_holds(double lower, double upper) const {
    return wanted_.sign_against_root_on(lower, upper);
  }
  /// 1 or -1 if that is the sign for certain where A and B have the signs they have on all of [lower, upper],
  /// and the norm this one, else 0.
  [[nodiscard]] int sign_by_norm(int norm, double lower, double upper) const {
    return side_ * with_condition(side_ * wanted_.sign_by_norm(norm, lower, upper), lower, upper);
  }
  /// Holds for the whole step, as A and B alone tell.
  [[nodiscard]] bool certainly_holds() const {
    return wanted_.certainly_positive() && (side_ < 0 || with_condition(1, 0, 0) > 0);
  }

 private:
  /// The sign where the radical has this one.
  [[nodiscard]] int with_condition(int radical, double lower, double upper) const {
    if constexpr (ConditionalFor<Certificate, M>) {
      if (conditional_ && radical >= 0) {
        const RadicalInDouble<typename Certificate::Condition, Errors, Certificate, M> condition(
            certificate_, motion_, 1, 1);
        const int sign = condition.certain_sign_on(lower, upper);
        return sign < 0 ? -1 : sign > 0 ? radical : 0;
      }
    }
    return radical;
  }

  const Certificate& certificate_;
  const M& motion_;
  int side_;
  bool conditional_ = false;
  RadicalInDouble<typename Certificate::Radical, Errors, Certificate, M> wanted_;
};

template <int Degree>
[[nodiscard]] BoundedPolynomial<Degree> negative(BoundedPolynomial<Degree> p) {
  for (double& c : p.bernstein) c = -c;
  return p;
}

/// Walks from candidate to candidate while they prove not to be failures, from `from` on, where the
/// certificate holds and the norm has the sign `known`, if that is not 0.
template <class InDouble>
[[nodiscard]] std::optional<Failure> walk_candidates(const InDouble& certificate, double from,
                                                     int known = 0) {
  constexpr int most_candidates = 8;
  for (int candidate = 0; candidate < most_candidates; ++candidate, known = 0) {
    const auto& norm = certificate.norm();
    const int sign = known != 0 ? known : norm.certain_sign_at(from);
    if (sign == 0) return std::nullopt;
    const auto next = (sign > 0 ? norm : negative(norm)).first_descent(from, known != 0);
    if (next.verdict == Verdict::never) return Failure{};
    if (next.verdict == Verdict::undecided) return std::nullopt;
    const auto& [lower, upper] = next.bracket;
    // The norm has one zero in the bracket, so the sign at its end is the one just after.
    const int after = certificate.certain_sign_on(upper, upper);
    if (after < 0) return Failure{Failure::Kind::later, {lower, upper, 0, true}};
    if (after == 0) return std::nullopt;
    from = upper;
  }
  return std::nullopt;
}

/// Settles a certificate in double, or nothing. At its own root the bracket holds no other one, so at its
/// upper end it still holds.
template <class InDouble>
[[nodiscard]] std::optional<Failure> settle_radical(const InDouble& certificate, const Instant& now,
                                                    Birth birth) {
  if (birth == Birth::at_own_root) {
    if (!now.isolating()) return std::nullopt;
    const int norm = certificate.norm_while_it_holds(now.lower(), now.upper());
    return norm == 0 ? std::nullopt : walk_candidates(certificate, now.upper(), norm);
  }
  const int sign = certificate.certain_sign_on(now.lower(), now.upper());
  // A sign below zero may belong to a sphere that is none, its beads in one place: integers know.
  if (sign <= 0) return std::nullopt;
  return walk_candidates(certificate, now.upper());
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

/// So wide a bracket will overlap others, and few signs are certain all over it: integers would be asked.
[[nodiscard]] inline bool is_wide(const Failure& failure) {
  return failure.kind == Failure::Kind::later && failure.time.upper - failure.time.lower > 0x1p-30;
}

template <class Certificate, Motion M>
[[nodiscard]] Failure filtered_first_failure(const Certificate& certificate, const M& motion,
                                             const Instant& now, Birth birth, StageCounts& stages,
                                             Touches touches) {
  std::optional<Failure> wide;
  {
    const CertificateInDouble<OwnFilter, Certificate, M> bounded(certificate, motion);
    if (bounded.certainly_holds()) {
      ++stages.coefficients;
      return {};
    }
    if (const auto failure = settle_radical(bounded, now, birth)) {
      if (!is_wide(*failure)) {
        ++stages.isolation;
        return *failure;
      }
      wide = failure;
    }
  }
  const CertificateInDouble<TrackedErrors, Certificate, M> tracked(certificate, motion);
  auto failure = settle_radical(tracked, now, birth);
  if (!failure) failure = wide;
  // As in careful_first_failure.
  if (!failure && now.narrow()) failure = settle_radical(tracked, now, birth);
  if (failure) {
    ++stages.refined;
    return *failure;
  }
  return exact_first_failure(exact_certificate(certificate, motion), now, stages, touches);
}

/// In plain doubles.
template <class Certificate, Motion M>
[[nodiscard]] Failure fast_first_failure(const Certificate& certificate, const M& motion, const Instant& now,
                                         Birth birth,
                                         StageCounts& stages) requires RadicalCertificateFor<Certificate, M> {
  const CertificateInDouble<NoErrors, Certificate, M> plain(certificate, motion);
  for (const double c : plain.norm().bernstein) {
    if (!std::isfinite(c)) return {};  // nothing can be said
  }
  const auto sign_at = [&](double u) { return plain.certain_sign_on(u, u); };
  double from = now.upper();
  if (birth == Birth::at_own_root || sign_at(from) == 0) {
    // Leave the root behind: the smallest step that makes the sign certain, or give the certificate up.
    double step = 0x1p-50;
    while (from + step < 1 && sign_at(from + step) <= 0 && step < 0x1p-20) step *= 4;
    from += step;
    if (!(from < 1)) return {};
    if (birth == Birth::at_own_root && sign_at(from) <= 0) return {};
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
                    std::span<const Birth> births, StageCounts& stages, Touches touches,
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
    int sign = CertificateInDouble<OwnFilter, Certificate, M>(certificate, motion)
                   .certain_sign_on(now.lower(), now.upper());
    if (sign == 0) {
      sign = CertificateInDouble<TrackedErrors, Certificate, M>(certificate, motion)
                 .certain_sign_on(now.lower(), now.upper());
    }
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
  const auto sign_by = [&]<class Errors>(Errors) {
    const detail::CertificateInDouble<Errors, Certificate, M> asked(certificate, motion);
    return asked.sign_by_norm(-detail::CertificateInDouble<Errors, Certificate, M>(failed, motion)
                                   .norm_while_it_holds(now.lower(), now.upper()),
                              now.lower(), now.upper());
  };
  if (!now.isolating()) return 0;
  int sign = sign_by(detail::OwnFilter{});
  if (sign == 0) sign = sign_by(detail::TrackedErrors{});
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
