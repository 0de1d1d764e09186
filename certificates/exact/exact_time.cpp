#include "certificates/exact/exact_time.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "certificates/exact/precise_values.h"

namespace kds {

namespace {

// To so many leading digits a time is narrowed before it is asked whether two are equal, which a common
// factor tells: cheaper while they differ, wasted where they are equal.
constexpr std::int64_t digits_before_gcd = 64;

std::int64_t exponent_of(const Integer& numerator, unsigned exponent) {
  return static_cast<std::int64_t>(mpz_sizeinbase(numerator.backend().data(), 2)) -
         static_cast<std::int64_t>(exponent);
}

bool has_digits_before_gcd(const ExactTime& time) {
  if (time.is_dyadic()) return true;
  const Dyadic& lower = time.lower();
  const Dyadic& upper = time.upper();
  const unsigned e = std::max(lower.exponent(), upper.exponent());
  const Integer from = lower.numerator() << (e - lower.exponent());
  const Integer to = upper.numerator() << (e - upper.exponent());
  const std::int64_t scale = std::min(exponent_of(to, e), exponent_of((Integer(1) << e) - from, e));
  return exponent_of(to - from, e) < scale - digits_before_gcd;
}

bool disjoint(const ExactTime& a, const ExactTime& b) {
  if (a.is_dyadic() && b.is_dyadic()) return !(a.lower() == b.lower());
  return a.upper() <= b.lower() || b.upper() <= a.lower();
}

// Whether the time is a root of g, which divides a polynomial that has no other root in the interval.
bool is_root(const ExactPolynomial& g, const ExactTime& time) {
  if (g.is_constant()) return false;
  if (time.is_dyadic()) return g.sign_at(time.lower()) == 0;
  return g.sign_at(time.lower()) * g.sign_at(time.upper()) < 0;
}

// The sign of `function` in the time's interval if its leading digits say that it has no root there, by
// Descartes' rule; else 0.
int sign_all_over(const ExactPolynomial& function, const ExactTime& time) {
  const Variations variations = function.variations_on(time.lower(), time.upper());
  return variations.most == 0 ? variations.sign : 0;
}

// The same by as many digits as it takes.
int sign_all_over_exactly(const ExactPolynomial& function, const ExactTime& time) {
  // Ends of unlike sign have a root between.
  const int sign = function.sign_at(time.upper());
  if (sign != 0 && sign == -function.sign_at(time.lower())) return 0;
  const Variations variations = exact_variations(function, time.lower(), time.upper());
  return variations.most == 0 ? variations.sign : 0;
}

// In which of `cells` equal parts of an interval a function is zero that is straight between its values at
// both ends.
Integer straight_zero(const LongEnclosure& at_lower, const LongEnclosure& at_upper, const Integer& cells) {
  Integer from = abs(at_lower.number()), to = abs(at_upper.number());
  const std::int64_t apart = at_upper.exponent() - at_lower.exponent();
  (apart > 0 ? to : from) <<= static_cast<std::size_t>(std::abs(apart));
  if (from + to == 0) return 0;
  const Integer cell = from * cells / (from + to);
  return cell < cells ? cell : Integer(cells - 1);
}

}  // namespace

ExactTime::ExactTime(ExactPolynomial square_free, RootInterval interval)
    : polynomial_(std::move(square_free)),
      lower_(std::move(interval.lower)),
      upper_(std::move(interval.upper)) {
  if (!is_dyadic()) sign_lower_ = polynomial_.sign_at(lower_);
}

void ExactTime::refine() {
  if (is_dyadic()) return;
  Dyadic middle = Dyadic::midpoint(lower_, upper_);
  const int sign = polynomial_.sign_at(middle);
  if (sign == 0) {
    lower_ = middle;
    upper_ = std::move(middle);
  } else if (sign == sign_lower_) {
    lower_ = std::move(middle);
  } else {
    upper_ = std::move(middle);
  }
}

bool ExactTime::narrow_to(const Dyadic& lower, const Dyadic& upper) {
  if (is_dyadic() || lower < lower_ || upper_ < upper) return false;
  if (polynomial_.sign_at(lower) != sign_lower_ || polynomial_.sign_at(upper) != -sign_lower_) return false;
  lower_ = lower;
  upper_ = upper;
  return true;
}

void ExactTime::narrow() {
  if (is_dyadic()) return;
  const auto take = [this](Dyadic point) {  // whether the time is after it
    const int sign = polynomial_.sign_at(point);
    if (sign == 0) {
      lower_ = point;
      upper_ = std::move(point);
      return false;
    }
    const bool after = sign == sign_lower_;
    (after ? lower_ : upper_) = std::move(point);
    return after;
  };
  if (Dyadic split = split_point(lower_, upper_); !(split == Dyadic::midpoint(lower_, upper_))) {
    take(std::move(split));
    return;
  }
  // One cell of 2^digits, beside the guessed one where the guess is wrong.
  constexpr unsigned most_digits = 4096;
  const Dyadic lower = lower_, upper = upper_;
  const Integer cells = Integer(1) << digits_;
  const Integer cell = straight_zero(value_at(polynomial_, lower, digits_ + 2),
                                     value_at(polynomial_, upper, digits_ + 2), cells);
  const auto border = [&](const Integer& number) {
    const unsigned exponent = std::max(lower.exponent(), upper.exponent());
    const Integer from = lower.numerator() << (exponent - lower.exponent());
    const Integer to = upper.numerator() << (exponent - upper.exponent());
    return Dyadic((from << digits_) + number * (to - from), exponent + digits_);
  };
  const bool after = cell == 0 || take(border(cell));
  const bool before = !is_dyadic() && after && (cell + 1 == cells || !take(border(cell + 1)));
  digits_ = after && before ? std::min(2 * digits_, most_digits) : std::max(1U, digits_ / 2);
}

void ExactTime::narrow_for_doubles() {
  constexpr double width = 0x1p-44, smallest = 0x1p-900;
  const auto wide = [&] {
    const double upper = upper_.round_up();
    return upper - lower_.round_down() > width * std::max(upper, smallest);
  };
  while (!is_dyadic() && wide()) narrow();
}

int ExactTime::compare(ExactTime& a, ExactTime& b) {
  while (!disjoint(a, b) && !(has_digits_before_gcd(a) && has_digits_before_gcd(b))) {
    if (!has_digits_before_gcd(a)) a.narrow();
    if (!has_digits_before_gcd(b)) b.narrow();
  }
  if (!disjoint(a, b)) {
    if (a.is_dyadic() && b.is_dyadic()) return 0;
    if (a.is_dyadic() || b.is_dyadic()) {
      if (a.is_dyadic() ? is_root(b.polynomial_, a) : is_root(a.polynomial_, b)) return 0;
    } else {
      // Common roots are the roots of g; the times are equal iff one lies in the overlap, where each has one
      // root.
      const ExactPolynomial g = ExactPolynomial::gcd(a.polynomial_, b.polynomial_).square_free();
      const Dyadic& lower = a.lower_ < b.lower_ ? b.lower_ : a.lower_;
      const Dyadic& upper = a.upper_ < b.upper_ ? a.upper_ : b.upper_;
      if (!g.is_constant() && g.sign_at(lower) * g.sign_at(upper) < 0) return 0;
    }
    while (!disjoint(a, b)) {
      a.narrow();
      b.narrow();
    }
  }
  if (a.upper_ <= b.lower_) return -1;
  return 1;
}

int sign_at(const ExactPolynomial& function, ExactTime& time) {
  if (function.is_zero()) return 0;
  for (bool enough = false; !time.is_dyadic() && !enough;) {
    if (const int sign = sign_all_over(function, time)) return sign;
    enough = has_digits_before_gcd(time);
    if (!enough) time.narrow();
  }
  if (time.is_dyadic()) return function.sign_at(time.lower());
  if (is_root(ExactPolynomial::gcd(time.polynomial(), function.square_free()), time)) return 0;
  return sign_after(function, time);
}

int sign_after(const ExactPolynomial& function, ExactTime& time) {
  if (function.is_zero()) return 0;
  if (time.is_dyadic()) return function.sign_after(time.lower());
  for (bool enough = false; !enough;) {
    if (const int sign = sign_all_over(function, time)) return sign;
    enough = has_digits_before_gcd(time);
    if (!enough) time.narrow();
    if (time.is_dyadic()) return function.sign_after(time.lower());
  }
  const ExactPolynomial simple = function.square_free();
  if (is_root(ExactPolynomial::gcd(time.polynomial(), simple), time)) {
    // Narrow until the time is the only root around; then the upper end tells.
    while (true) {
      const Variations variations = exact_variations(simple, time.lower(), time.upper());
      if (variations.most == 1) {
        if (const int sign = function.sign_at(time.upper())) return sign;
      }
      time.narrow();
      if (time.is_dyadic()) return function.sign_after(time.lower());
    }
  }
  while (true) {
    if (const int sign = sign_all_over_exactly(function, time)) return sign;
    time.narrow();
    if (time.is_dyadic()) return function.sign_after(time.lower());
  }
}

std::optional<ExactFailure> first_failure_after(const ExactPolynomial& function, const ExactTime& now,
                                                TouchPolicy touches) {
  const Dyadic end(1.0);
  if (!(now.upper() < end) || function.is_zero() || function.sign_variations() == 0) return std::nullopt;
  const bool from_root = now.is_dyadic() && function.sign_at(now.upper()) == 0;
  const ExactPolynomial simple = function.square_free();
  std::optional<ExactFailure> failure;
  bool present = from_root;  // the first root is the present time
  visit_roots(simple, now.upper(), end, [&](RootInterval root) {
    if (std::exchange(present, false)) return true;
    if (root.lower == end) return false;  // what happens at u = 1 is judged by the next step
    ExactTime time(simple, std::move(root));
    // The only root around, so the upper end tells, unless the function is zero at the end of the step.
    const int at_upper = time.is_dyadic() ? 0 : function.sign_at(time.upper());
    const bool touch = (at_upper != 0 ? at_upper : sign_after(function, time)) > 0;
    if (!touch || touches == TouchPolicy::reported) failure = {std::move(time), touch};
    return !failure;
  });
  return failure;
}

Dyadic dyadic_between(ExactTime& a, ExactTime& b) {
  if (ExactTime::compare(a, b) >= 0) return a.upper();  // caller's error; nothing lies between
  while (!(a.upper() < b.lower())) {
    if (a.upper() == b.lower() && !a.is_dyadic() && !b.is_dyadic()) return a.upper();
    a.narrow();
    b.narrow();
  }
  return Dyadic::midpoint(a.upper(), b.lower());
}

Dyadic next_on_grid(ExactTime& time, unsigned bits) {
  // floor(x 2^bits) + 1
  const auto after = [bits](const Dyadic& x) -> Integer {
    const Integer scaled = x.numerator() << bits;
    return (scaled >> x.exponent()) + 1;
  };
  while (!time.is_dyadic()) {
    const Dyadic next(after(time.lower()), bits);
    if (time.upper() <= next) return next;
    if (time.polynomial().sign_at(next) == 0) {  // halving may miss a time on the grid for ever
      time = ExactTime(next);
    } else {
      time.narrow();
    }
  }
  return {after(time.lower()), bits};
}

}  // namespace kds
