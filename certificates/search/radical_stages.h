#pragma once
// The stages of radical certificates (radical.h): in double, by the norm with its error bounds and signs
// during a short time, and in integers, for results that doubles cannot prove.

#include <cstdint>
#include <numeric>
#include <optional>

#include "certificates/base/kernel.h"
#include "certificates/base/radical.h"
#include "certificates/exact/exact_time.h"
#include "certificates/exact/instant.h"
#include "certificates/filters/tracked_moment.h"
#include "certificates/formulas/function_values.h"
#include "certificates/search/exact_search.h"

namespace kds {

/// A + B sqrt(D), represented by the integer polynomials A, B and the norm.
struct ExactRadical {
  ExactPolynomial rational, root, norm;

  /// Returns the sign, computed by applying `sign_of` (sign_at or sign_after) to the polynomials.
  [[nodiscard]] int sign(ExactTime& time, int (*sign_of)(const ExactPolynomial&, ExactTime&)) const;
};

/// A radical certificate with integer coefficients.
struct ExactRadicalCertificate {
  ExactRadical radical;
  std::optional<ExactRadical> condition;
  bool side = true;

  [[nodiscard]] int sign(ExactTime& time, int (*sign_of)(const ExactPolynomial&, ExactTime&)) const;
  /// Returns whether a candidate at which the certificate is positive just after is a touch: zero there and
  /// positive on both sides.
  [[nodiscard]] bool touches(ExactTime& candidate) const;
  /// Returns a polynomial that has all roots of the certificate's function: the norm, or A B if the norm is
  /// zero.
  [[nodiscard]] ExactPolynomial candidates() const;
  [[nodiscard]] std::size_t largest_bit_length() const;
};

/// Runs the exact stage alone, with the same answers as that of polynomial certificates (exact_search.h). The
/// candidates for a failure are all distinct roots of the norm, even those at which the norm does not change
/// sign. Each candidate is judged by the function's sign just after it. If the norm is the zero polynomial,
/// the candidates are the roots of A and of B.
[[nodiscard]] Failure exact_first_failure(const ExactRadicalCertificate& certificate, const Instant& now,
                                          StageCounts& stages, TouchPolicy touches = TouchPolicy::ignored);

/// A radical certificate in double, of any type.
class RadicalInDouble {
 public:
  virtual ~RadicalInDouble() = default;

  [[nodiscard]] virtual const BoundedPolynomial& norm() const = 0;
  /// Returns 1 or -1 if that is certainly the sign on all of [lower, upper], else 0.
  [[nodiscard]] virtual int certain_sign_on(double lower, double upper) const = 0;
  /// Like certain_sign_on, but uses a known sign of the norm; `norm_sign` is 0 if it is unknown.
  [[nodiscard]] virtual int sign_by_norm(int norm_sign, double lower, double upper) const = 0;
  /// Returns the norm's sign where the certificate holds, if opposite signs of A and B on all of [lower,
  /// upper] determine it, else 0. At an isolating failure time the norm changes its sign, so just after it
  /// the norm has the opposite sign.
  [[nodiscard]] virtual int norm_while_it_holds(double lower, double upper) const = 0;
  /// Returns whether the certificate is certainly usable (radical.h) on all of [lower, upper].
  [[nodiscard]] virtual bool is_usable_on(double lower, double upper) const = 0;
  /// Returns the norm's sign at a time, or 0 if unknown.
  [[nodiscard]] virtual int certain_norm_at(double u) const = 0;
};

/// Returns the failure that doubles prove for a certificate, or nothing. If `known` is at_own_root and
/// the bracket of `now` is isolating, the certificate still holds at the bracket's upper end.
[[nodiscard]] std::optional<Failure> proved_failure(const RadicalInDouble& certificate, const Instant& now,
                                                    KnownAtStart known);

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

/// How errors are bounded in double. `own_filter`: the norm's polynomial has the error bounds of the
/// function's own filter. `tracked`: the norm's errors are followed operation by operation. In both cases
/// only certain signs during a short time are used, computed without polynomials.
enum class Errors : std::uint8_t { own_filter, tracked };

/// The signs of a radical's polynomials during a short time, each computed on demand.
template <class Radical, MotionView View>
class RadicalSigns {
  using Beads = decltype(typename Radical::Norm{}.beads);

 public:
  /// Multiplies the radical by `sign`, and its root part also by `root_sign`.
  RadicalSigns(const View& view, const Beads& beads, int sign, int root_sign)
      : view_(view), arguments_(beads), sign_(sign), root_sign_(root_sign) {
    std::iota(arguments_.begin(), arguments_.end(), 0U);
  }

  [[nodiscard]] int rational() const { return of<typename Radical::Rational>(sign_); }
  [[nodiscard]] int root() const { return of<typename Radical::Root>(sign_ * root_sign_); }
  [[nodiscard]] int norm() const { return of<typename Radical::Norm>(1); }

  /// Returns the sign of the whole radical, or 0 if unknown. The caller may supply the norm's sign.
  [[nodiscard]] int whole(int norm_sign = 0) const {
    const int a = rational(), b = root();
    return a == b ? a : sign_of_radical(a, b, norm_sign != 0 ? norm_sign : norm());
  }
  /// Returns the sign of the whole radical for a known sign of the norm, or 0.
  [[nodiscard]] int whole_by_norm(int norm_sign) const {
    return sign_of_radical(rational(), root(), norm_sign);
  }

 private:
  template <class Polynomial>
  [[nodiscard, gnu::flatten, gnu::noinline]] int of(int sign) const {
    return sign * certain_sign(Polynomial::formula(view_, arguments_).scaled[0]);
  }

  const View& view_;
  Beads arguments_;
  int sign_, root_sign_;
};

/// A radical certificate in double. `C`: Curves.
template <class Certificate, class C>
class CertificateInDouble final : public RadicalInDouble {
 public:
  CertificateInDouble(Errors errors, const Certificate& certificate, const C& curves)
      : errors_(errors), certificate_(certificate), curves_(curves), side_(certificate.side() ? 1 : -1) {
    if constexpr (ConditionalFor<Certificate, C>) conditional_ = certificate.conditional(curves);
  }

  [[nodiscard]] const BoundedPolynomial& norm() const override {
    if (!norm_) norm_ = bounded_norm();
    return *norm_;
  }
  [[nodiscard]] int certain_sign_on(double lower, double upper) const override {
    const View view(curves_, certificate_.beads, lower, upper, channels);
    const int norm_sign = norm_ ? norm_->certain_sign_on(lower, upper) : 0;
    return side_ * with_condition(side_ * wanted(view).whole(norm_sign), view);
  }
  [[nodiscard]] int sign_by_norm(int norm_sign, double lower, double upper) const override {
    const View view(curves_, certificate_.beads, lower, upper, channels);
    return side_ * with_condition(side_ * wanted(view).whole_by_norm(norm_sign), view);
  }
  [[nodiscard]] int norm_while_it_holds(double lower, double upper) const override {
    const View view(curves_, certificate_.beads, lower, upper, channels);
    const int a = wanted(view).rational();
    return a != 0 && wanted(view).root() == -a ? a : 0;
  }
  [[nodiscard]] bool is_usable_on(double lower, double upper) const override {
    const auto certain = [](const TrackedDouble& number) { return certain_sign(number); };
    if constexpr (requires(View & view) { Certificate::is_usable(view, certificate_.beads, certain); }) {
      const View view(curves_, certificate_.beads, lower, upper, channels);
      auto arguments = certificate_.beads;
      std::iota(arguments.begin(), arguments.end(), 0U);
      return Certificate::is_usable(view, arguments, certain);
    }
    return true;
  }
  [[nodiscard]] int certain_norm_at(double u) const override {
    if (norm_)
      if (const int sign = norm_->certain_sign_at(u)) return sign;
    const View view(curves_, certificate_.beads, u, u, channels);
    return wanted(view).norm();
  }

 private:
  using Norm = SignedPart<typename Certificate::Radical::Norm>;
  using View = TrackedMoment<C>;
  static constexpr Channels channels{.weights = false, .radii = true};
  static_assert(!channels_of<typename Certificate::Radical::Rational>.weights &&
                    !channels_of<typename Certificate::Radical::Root>.weights &&
                    !channels_of<typename Certificate::Radical::Norm>.weights,
                "a radical certificate is of centres and radii: it cannot ask for weights");

  [[nodiscard]] BoundedPolynomial bounded_norm() const {
    using Values = FunctionValues<Norm, C>;
    const auto part = part_of<typename Certificate::Radical::Norm>(certificate_);
    if (errors_ == Errors::tracked) return Values::tracked(part, curves_).polynomial;
    return Values::bounded(part, curves_).polynomial;
  }
  [[nodiscard]] auto wanted(const View& view) const {
    return RadicalSigns<typename Certificate::Radical, View>(view, certificate_.beads, side_,
                                                             certificate_.root_sign());
  }
  /// Returns the certificate's sign, condition included, for a radical with the given sign.
  [[nodiscard]] int with_condition(int radical, const View& view) const {
    if constexpr (ConditionalFor<Certificate, C>) {
      if (conditional_ && radical >= 0) {
        const int sign =
            RadicalSigns<typename Certificate::Condition, View>(view, certificate_.beads, 1, 1).whole();
        return sign < 0 ? -1 : sign > 0 ? radical : 0;
      }
    }
    return radical;
  }

  Errors errors_;
  const Certificate& certificate_;
  const C& curves_;
  int side_;
  bool conditional_ = false;
  mutable std::optional<BoundedPolynomial> norm_;
};

}  // namespace detail

}  // namespace kds
