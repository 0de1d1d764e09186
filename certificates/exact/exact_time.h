#pragma once
// An exact time in a step: a root of a polynomial with integer coefficients, or a dyadic number. Narrowing
// the isolating interval changes the representation, never the value.

#include <cstdint>
#include <memory>
#include <optional>

#include "certificates/exact/exact_polynomial.h"
#include "certificates/exact/instant.h"

namespace kds {

class ExactTime {
 public:
  explicit ExactTime(const Dyadic& time) : root_{time, time} {}
  /// Constructs the root of `polynomial` in `interval`. The root must be the only one there, and the
  /// polynomial must change sign at it.
  ExactTime(ExactPolynomial polynomial, RootInterval interval);

  [[nodiscard]] bool is_dyadic() const { return root_.lower == root_.upper; }
  [[nodiscard]] const Dyadic& lower() const { return root_.lower; }  ///< < the time; equal if is_dyadic()
  [[nodiscard]] const Dyadic& upper() const { return root_.upper; }  ///< > the time; equal if is_dyadic()
  [[nodiscard]] const ExactPolynomial& polynomial() const { return polynomial_; }  ///< unused if is_dyadic()

  /// Halves the interval, or finds that the time is its midpoint. For a root of a wide polynomial, narrows
  /// the interval by as much as seems likely to succeed (narrow_root).
  void refine();
  /// Returns whether the time lies in [lower, upper], and if so narrows its interval to it. The ends must not
  /// be roots.
  bool narrow_to(const Dyadic& lower, const Dyadic& upper);
  /// Narrows the interval to about 2^-44, which separates nearly all failure times of a step: first around a
  /// guess, then by bisection. A root of a wide polynomial may have any scale, so it is narrowed to a
  /// relative precision.
  void narrow_for_doubles();
  /// Narrows the interval to at most `width` > 0: first around a guess, then by refining.
  void narrow_to_width(double width);

  /// Returns -1, 0 or 1 if a is before, equal to or after b. Narrows both.
  [[nodiscard]] static int compare(ExactTime& a, ExactTime& b);

 private:
  friend Dyadic next_on_grid(ExactTime& time, unsigned bits);
  /// Moves an end of the interval to `point`, which lies within, or both if `point` is the time.
  void cut_at(Dyadic point);

  ExactPolynomial polynomial_;
  RootInterval root_;
};

/// Returns the sign of `function` at the time itself. Narrows `time`.
[[nodiscard]] int sign_at(const ExactPolynomial& function, ExactTime& time);

/// Returns the sign of `function` on (time, time + delta), 0 only for the zero function. Narrows `time` until
/// `function` has no root between it and time.upper().
[[nodiscard]] int sign_after(const ExactPolynomial& function, ExactTime& time);

struct ExactFailure {
  ExactTime time;
  bool touch = false;
};
/// Returns the first time after `now` and before the end of the step at which `function` turns negative. If
/// touches are reported, returns an earlier time at which it touches zero. Returns nothing if there is no
/// such time. `function` must be positive just after `now`, as sign_after() has shown; that call also
/// narrowed `now` as required here.
[[nodiscard]] std::optional<ExactFailure> first_failure_after(const ExactPolynomial& function,
                                                              const ExactTime& now,
                                                              TouchPolicy touches = TouchPolicy::ignored);

/// Returns a dyadic number strictly between two different times. a must be before b.
[[nodiscard]] Dyadic dyadic_between(ExactTime& a, ExactTime& b);

/// Returns the first multiple of 2^-bits after `time`. If `time` itself is a multiple, it becomes dyadic.
[[nodiscard]] Dyadic next_on_grid(ExactTime& time, unsigned bits);

}  // namespace kds
