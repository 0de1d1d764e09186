#pragma once
// Radical certificates (radical.h) in double: signs during a short time, and the walk along the roots of the
// norm to the first failure. What cannot be proved is left to integers (radical_search.h).

#include <numeric>
#include <optional>
#include <utility>

#include "certificates/base/radical.h"
#include "certificates/search/failure_search.h"
#include "certificates/search/tracked_moment.h"

namespace kds::detail {

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

/// What is known of a radical in double: of its norm, a polynomial with errors, by the certificate type's own
/// filter or followed operation by operation, and of signs during a short time, without polynomials.
struct OwnFilter {
  template <class Part, Motion M>
  [[nodiscard]] static auto bounded(const Part& part, const M& motion) {
    return bounded_function(part, motion).function;
  }
  [[nodiscard]] static int sign_of(const TrackedDouble& number) { return certain_sign(number); }
};
struct TrackedErrors {
  template <class Part, Motion M>
  [[nodiscard]] static auto bounded(const Part& part, const M& motion) {
    return tracked_function(part, motion).function;
  }
  [[nodiscard]] static int sign_of(const TrackedDouble& number) { return certain_sign(number); }
};
/// Nothing certain, everything taken to be.
struct NoErrors {
  template <class Part, Motion M>
  [[nodiscard]] static auto bounded(const Part& part, const M& motion) {
    auto function = bounded_function(part, motion).function;
    function.value_error = function.local_error = 0;
    return function;
  }
  [[nodiscard]] static int sign_of(const TrackedDouble& number) {
    return number.value > 0 ? 1 : number.value < 0 ? -1 : 0;
  }
};

/// The signs of a radical's polynomials during a short time, each when it is asked for.
template <class Radical, class Errors, MotionView View>
class RadicalSigns {
 public:
  /// Times `sign`, and the root by `root_sign` too.
  RadicalSigns(const View& view, int sign, int root_sign) : view_(view), sign_(sign), root_sign_(root_sign) {}

  [[nodiscard]] int rational() const { return of<typename Radical::Rational>(sign_); }
  [[nodiscard]] int root() const { return of<typename Radical::Root>(sign_ * root_sign_); }
  [[nodiscard]] int norm() const { return of<typename Radical::Norm>(1); }

  /// Of the whole, or 0; the norm's sign may be known.
  [[nodiscard]] int whole(int norm_sign = 0) const {
    const int a = rational(), b = root();
    return a == b ? a : sign_of_radical(a, b, norm_sign != 0 ? norm_sign : norm());
  }
  /// The same where the norm's sign is known, or 0.
  [[nodiscard]] int whole_by_norm(int norm_sign) const {
    return sign_of_radical(rational(), root(), norm_sign);
  }

 private:
  template <class Polynomial>
  [[nodiscard, gnu::flatten, gnu::noinline]] int of(int sign) const {
    auto places = Polynomial{}.beads;
    std::iota(places.begin(), places.end(), 0U);
    return sign * Errors::sign_of(Polynomial::formula(view_, places).scaled[0]);
  }

  const View& view_;
  int sign_, root_sign_;
};

/// A radical certificate in double.
template <class Errors, class Certificate, Motion M>
class CertificateInDouble {
 public:
  CertificateInDouble(const Certificate& certificate, const M& motion)
      : certificate_(certificate), motion_(motion), side_(certificate.side() ? 1 : -1) {
    if constexpr (ConditionalFor<Certificate, M>) conditional_ = certificate.conditional(motion);
  }

  [[nodiscard]] const auto& norm() const {
    if (!norm_) norm_ = Errors::bounded(part_of<Norm>(certificate_), motion_);
    return *norm_;
  }
  /// 1 or -1 if that is the sign all over [lower, upper] for certain, else 0.
  [[nodiscard]] int certain_sign_on(double lower, double upper) const {
    const View view(motion_, certificate_.beads, lower, upper);
    const int norm_sign = norm_ ? norm_->certain_sign_on(lower, upper) : 0;
    return side_ * with_condition(side_ * wanted(view).whole(norm_sign), view);
  }
  /// The same where the norm's sign is known, or 0.
  [[nodiscard]] int sign_by_norm(int norm_sign, double lower, double upper) const {
    const View view(motion_, certificate_.beads, lower, upper);
    return side_ * with_condition(side_ * wanted(view).whole_by_norm(norm_sign), view);
  }
  /// The norm's sign where the certificate holds, as A and B of opposite signs all over [lower, upper] tell,
  /// else 0. At an isolating failure time, where the norm changes its sign, it has the other just after.
  [[nodiscard]] int norm_while_it_holds(double lower, double upper) const {
    const View view(motion_, certificate_.beads, lower, upper);
    const int a = wanted(view).rational();
    return a != 0 && wanted(view).root() == -a ? a : 0;
  }
  /// Whether the certificate may be in use (radical.h) all over [lower, upper], for certain.
  [[nodiscard]] bool is_usable_on(double lower, double upper) const {
    if constexpr (requires(View & view) {
                    Certificate::is_usable(view, certificate_.beads, Errors::sign_of);
                  }) {
      const View view(motion_, certificate_.beads, lower, upper);
      auto places = certificate_.beads;
      std::iota(places.begin(), places.end(), 0U);
      return Certificate::is_usable(view, places, Errors::sign_of);
    }
    return true;
  }
  /// The norm's sign at a time, or 0.
  [[nodiscard]] int certain_norm_at(double u) const {
    if (norm_)
      if (const int sign = norm_->certain_sign_at(u)) return sign;
    const View view(motion_, certificate_.beads, u, u);
    return wanted(view).norm();
  }

 private:
  using Norm = typename Certificate::Radical::Norm;
  using View = TrackedMoment<M, bead_places<Certificate>>;
  using NormInDouble =
      decltype(Errors::bounded(part_of<Norm>(std::declval<const Certificate&>()), std::declval<const M&>()));

  [[nodiscard]] auto wanted(const View& view) const {
    return RadicalSigns<typename Certificate::Radical, Errors, View>(view, side_, certificate_.root_sign());
  }
  /// The sign where the radical has this one.
  [[nodiscard]] int with_condition(int radical, const View& view) const {
    if constexpr (ConditionalFor<Certificate, M>) {
      if (conditional_ && radical >= 0) {
        const int sign = RadicalSigns<typename Certificate::Condition, Errors, View>(view, 1, 1).whole();
        return sign < 0 ? -1 : sign > 0 ? radical : 0;
      }
    }
    return radical;
  }

  const Certificate& certificate_;
  const M& motion_;
  int side_;
  bool conditional_ = false;
  mutable std::optional<NormInDouble> norm_;
};

template <int Degree>
[[nodiscard]] BoundedPolynomial<Degree> negative(BoundedPolynomial<Degree> p) {
  for (double& c : p.bernstein) c = -c;
  return p;
}

/// A narrower bracket around the only root of the norm in this one, where it turns from `sign`: around the
/// root of the polynomial as it is in double, as far as signs are certain.
template <class InDouble, class Bracket>
[[nodiscard]] Bracket narrowed(const InDouble& certificate, Bracket bracket, int sign) {
  const double root = (sign > 0 ? certificate.norm() : negative(certificate.norm()))
                          .root_between(bracket.lower, bracket.upper);
  bool below = true, above = true;  // ends still to be found
  for (double reach = 0x1p-38; (below || above) && reach < 0.1; reach *= 64) {
    if (below && root - reach > bracket.lower && certificate.certain_norm_at(root - reach) == sign) {
      bracket.lower = root - reach;
      below = false;
    }
    if (above && root + reach < bracket.upper && certificate.certain_norm_at(root + reach) == -sign) {
      bracket.upper = root + reach;
      above = false;
    }
  }
  return bracket;
}

/// Walks from candidate to candidate while they prove not to be failures, from `from` on, where the
/// certificate holds and the norm has the sign `known`, if that is not 0.
template <class InDouble>
[[nodiscard]] std::optional<Failure> walk_candidates(const InDouble& certificate, double from,
                                                     int known = 0) {
  constexpr int most_candidates = 8;
  // So wide a bracket would overlap others, and few signs would be certain all over it.
  constexpr double wide = 0x1p-30;
  for (int candidate = 0; candidate < most_candidates; ++candidate, known = 0) {
    const auto& norm = certificate.norm();
    const int sign = known != 0 ? known : certificate.certain_norm_at(from);
    if (sign == 0) return std::nullopt;
    const auto next = (sign > 0 ? norm : negative(norm)).first_descent(from, true);
    if (next.verdict == Verdict::never) return Failure{};
    if (next.verdict == Verdict::undecided) return std::nullopt;
    auto bracket = next.bracket;
    if (bracket.upper - bracket.lower > wide) bracket = narrowed(certificate, bracket, sign);
    const auto [lower, upper] = bracket;
    // The norm has one zero in the bracket. What A and B are certain to be all over it tells the sign just
    // after, or the certificate has gone out of use before. Else the bracket's end tells it, unless it goes
    // out of use in between.
    int after = certificate.sign_by_norm(-sign, lower, upper);
    if (after == 0 && certificate.is_usable_on(lower, upper))
      after = certificate.sign_by_norm(-sign, upper, upper);
    if (after == 0) return std::nullopt;
    if (after < 0) return Failure{Failure::Kind::later, {lower, upper, 0, true}};
    from = upper;
  }
  return std::nullopt;
}

/// Settles a certificate in double, or nothing. At its own root the bracket holds no other one, so at its
/// upper end it still holds.
template <class InDouble>
[[nodiscard]] std::optional<Failure> classify_radical(const InDouble& certificate, const Instant& now,
                                                      KnownAtStart birth) {
  if (birth == KnownAtStart::at_own_root) {
    if (!now.isolating()) return std::nullopt;
    const int norm = certificate.norm_while_it_holds(now.lower(), now.upper());
    return norm == 0 ? std::nullopt : walk_candidates(certificate, now.upper(), norm);
  }
  static_cast<void>(certificate.norm());  // it is wanted soon, and knows signs already
  const int sign = certificate.certain_sign_on(now.lower(), now.upper());
  // A sign below zero may belong to a sphere that is none, its beads in one place: integers know.
  if (sign <= 0) return std::nullopt;
  return walk_candidates(certificate, now.upper());
}

}  // namespace kds::detail
