#pragma once
// An exact time in a step: a root of a polynomial with whole coefficients, or a dyadic number. Exact
// throughout; narrowing its interval changes the representation, never the value.

#include <optional>

#include "certificates/base/failure_time.h"
#include "certificates/exact/exact_polynomial.h"

namespace kds {

class ExactTime {
 public:
  explicit ExactTime(const Dyadic& time) : root_{time, time} {}
  /// The root of `polynomial` in `interval`: the only one there, and the polynomial changes sign at it.
  ExactTime(ExactPolynomial polynomial, RootInterval interval);

  [[nodiscard]] bool is_dyadic() const { return root_.lower == root_.upper; }
  [[nodiscard]] const Dyadic& lower() const { return root_.lower; }  ///< < the time, or equal if is_dyadic()
  [[nodiscard]] const Dyadic& upper() const { return root_.upper; }  ///< > the time, or equal if is_dyadic()
  [[nodiscard]] const ExactPolynomial& polynomial() const { return polynomial_; }  ///< unused if is_dyadic()

  /// Halves the interval, or finds that the time is its middle; of a wide polynomial's root, narrows it by as
  /// much as seems likely (narrow_root).
  void refine();
  /// Narrows the interval to this one if the time lies in it; returns whether it does. Ends must not be
  /// roots.
  bool narrow_to(const Dyadic& lower, const Dyadic& upper);
  /// Narrows the interval to about 2^-44, which keeps nearly all failure times of a step apart: around a
  /// guess, or by bisection. A wide polynomial's root lies in any scale: it is narrowed to so many digits.
  void narrow_for_doubles();
  /// Narrows the interval to at most `width`, a positive number: around a guess first, then by refining.
  void narrow_to_width(double width);

  /// -1, 0 or 1 where a is before b, equal, or after. Narrows both.
  [[nodiscard]] static int compare(ExactTime& a, ExactTime& b);

 private:
  ExactPolynomial polynomial_;
  RootInterval root_;
};

/// Sign of `function` at the time itself. Narrows `time`.
[[nodiscard]] int sign_at(const ExactPolynomial& function, ExactTime& time);

/// Sign of `function` on (time, time + delta), 0 only for the zero function. Narrows `time` until `function`
/// has no root between it and time.upper().
[[nodiscard]] int sign_after(const ExactPolynomial& function, ExactTime& time);

struct ExactFailure {
  ExactTime time;
  bool touch = false;
};
/// The first time after `now`, before the end of the step, from which on `function` is negative, or, if they
/// are reported, at which it touches zero; none if there is none. `function` must be positive just after
/// `now`, by sign_after, which narrowed `now` for this.
[[nodiscard]] std::optional<ExactFailure> first_failure_after(const ExactPolynomial& function,
                                                              const ExactTime& now,
                                                              TouchPolicy touches = TouchPolicy::ignored);

/// A dyadic strictly between two different times, a before b.
[[nodiscard]] Dyadic dyadic_between(ExactTime& a, ExactTime& b);

/// The first multiple of 2^-bits after `time`.
[[nodiscard]] Dyadic next_on_grid(ExactTime& time, unsigned bits);

}  // namespace kds
