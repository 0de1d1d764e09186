#include "certificates/exact/exact_time.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include "certificates/exact/wide_polynomial.h"
#include "certificates/exact/wide_roots.h"

namespace kds {

namespace {

// When to try a gcd. Bisection is cheaper while two times differ, but it is wasted if they are equal, so a
// gcd is tried after a few bisections. The root of a wide polynomial may have any scale; it is first narrowed
// to `digits_before_gcd` digits. A time with `most_bits_before_gcd` bits after the point is narrow enough:
// without this limit, a time at which thousands of functions vanish would be narrowed by a few bits for each
// of them, and the numbers would grow with the number of comparisons.
constexpr int bisections_before_gcd = 4;
constexpr unsigned digits_before_gcd = 64, most_bits_before_gcd = 256;

bool wants_gcd(const ExactTime& time, int bisections) {
  if (time.is_dyadic()) return true;
  if (time.polynomial().wide() != nullptr) return has_digits({time.lower(), time.upper()}, digits_before_gcd);
  return bisections >= bisections_before_gcd ||
         std::min(time.lower().exponent(), time.upper().exponent()) >= most_bits_before_gcd;
}

// Returns true if the time was constructed from this very polynomial, and is thus its only root in the
// interval. Compares addresses, so false proves nothing.
bool is_made_from(const ExactTime& time, const ExactPolynomial& square_free) {
  return !time.is_dyadic() && square_free.wide() != nullptr && square_free.wide() == time.polynomial().wide();
}

bool disjoint(const ExactTime& a, const ExactTime& b) {
  if (a.is_dyadic() && b.is_dyadic()) return !(a.lower() == b.lower());
  return a.upper() <= b.lower() || b.upper() <= a.lower();
}

const Dyadic& later_of(const Dyadic& a, const Dyadic& b) { return a < b ? b : a; }
const Dyadic& earlier_of(const Dyadic& a, const Dyadic& b) { return a < b ? a : b; }

bool changes_sign_between(const ExactPolynomial& p, const Dyadic& lower, const Dyadic& upper) {
  return p.sign_at(lower) * p.sign_at(upper) < 0;
}

// Returns whether the time is a root of g. g must divide a polynomial without other roots in the interval.
bool is_root(const ExactPolynomial& g, const ExactTime& time) {
  if (g.is_constant()) return false;
  if (time.is_dyadic()) return g.sign_at(time.lower()) == 0;
  return changes_sign_between(g, time.lower(), time.upper());
}

// Returns the sign of `function` on the time's interval if `function` provably has no root there, else 0.
int sign_all_over(const ExactPolynomial& function, const ExactTime& time, bool exactly = false) {
  return function.sign_between(time.lower(), time.upper(), exactly);
}

// Returns an approximate value of the time, by bisection in double on the coefficients over the interval.
double rough(const ExactTime& time) {
  const ExactPolynomial local = time.polynomial().restricted(time.lower(), time.upper());
  const auto shift = static_cast<long>(local.largest_bit_length());
  std::vector<double> c;
  for (const Integer& x : local.scaled()) {
    long exponent = 0;
    const double fraction = mpz_get_d_2exp(&exponent, x.get_mpz_t());
    c.push_back(std::ldexp(fraction, static_cast<int>(std::max(exponent - shift, -1100L))));
  }
  const auto value = [&c](double s) {
    double sum = c.back();
    double power = 1;
    for (std::size_t k = c.size() - 1; k-- > 0;) {
      power *= 1 - s;
      sum = sum * s + c[k] * power;
    }
    return sum;
  };
  const bool rising = c.front() < 0;
  double low = 0;
  double high = 1;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    ((value(middle) < 0) == rising ? low : high) = middle;
  }
  const double lower = time.lower().round_down();
  return lower + (time.upper().round_up() - lower) * low;
}

}  // namespace

ExactTime::ExactTime(ExactPolynomial square_free, RootInterval interval)
    : polynomial_(std::move(square_free)), root_(std::move(interval)) {
  if (!is_dyadic() && root_.sign_at_lower == 0) root_.sign_at_lower = polynomial_.sign_at(root_.lower);
}

void ExactTime::refine() {
  if (is_dyadic()) return;
  // Halving gains one bit per step, which is too slow for a root of a very different scale or with
  // thousands of digits.
  constexpr unsigned few_bits = 256;
  if (polynomial_.wide() == nullptr && root_.upper.exponent() > few_bits)
    polynomial_ = ExactPolynomial(std::make_shared<const WidePolynomial>(polynomial_.scaled()));
  if (polynomial_.wide() != nullptr) return narrow_root(*polynomial_.wide(), root_);
  cut_at(Dyadic::midpoint(root_.lower, root_.upper));
}

void ExactTime::cut_at(Dyadic point) {
  const int sign = polynomial_.sign_at(point);
  if (sign == 0) {
    root_ = {point, point};
  } else if (sign == root_.sign_at_lower) {
    root_.lower = std::move(point);
  } else {
    root_.upper = std::move(point);
  }
}

bool ExactTime::narrow_to(const Dyadic& lower, const Dyadic& upper) {
  if (is_dyadic() || lower < root_.lower || root_.upper < upper) return false;
  if (polynomial_.sign_at(lower) != root_.sign_at_lower || polynomial_.sign_at(upper) != -root_.sign_at_lower)
    return false;
  root_.lower = lower;
  root_.upper = upper;
  return true;
}

void ExactTime::narrow_for_doubles() {
  constexpr double width = 0x1p-44;
  if (is_dyadic()) return;
  if (polynomial_.wide() != nullptr) {
    constexpr double least = 0x1p-900;  // doubles have full precision from here on
    const auto is_wide = [&] {
      const double upper = root_.upper.round_up();
      return upper - root_.lower.round_down() > width * std::max(upper, least);
    };
    while (!is_dyadic() && is_wide()) refine();
    return;
  }
  const double guess = rough(*this);
  for (const double reach : {0x1p-46, 0x1p-42}) {
    if (narrow_to(Dyadic(guess - reach), Dyadic(guess + reach))) return;
  }
  while (!is_dyadic() && root_.upper.round_up() - root_.lower.round_down() > width) refine();
}

void ExactTime::narrow_to_width(double width) {
  const auto is_wide = [&] { return root_.upper.rational() - root_.lower.rational() > Rational(width); };
  if (!is_dyadic() && polynomial_.wide() == nullptr && is_wide()) {
    const double guess = rough(*this);
    for (const double reach : {0.25 * width, 16 * width})
      if (narrow_to(Dyadic(guess - reach), Dyadic(guess + reach))) break;
  }
  while (!is_dyadic() && is_wide()) refine();
}

namespace {

// Returns the number of bits after the point down to the length of the time's interval.
std::int64_t bits_of(const ExactTime& time) {
  const unsigned exponent = std::max(time.lower().exponent(), time.upper().exponent());
  const Integer length = (time.upper().numerator() << (exponent - time.upper().exponent())) -
                         (time.lower().numerator() << (exponent - time.lower().exponent()));
  return std::int64_t{exponent} - static_cast<std::int64_t>(bit_length(length));
}

// Refines both times, but not one that is far ahead of the other. A step gains one bit for some times and
// thousands of bits for others, and the surplus would never be used.
void refine_both(ExactTime& a, ExactTime& b) {
  constexpr std::int64_t far_ahead = 64;
  const std::int64_t ahead = a.is_dyadic() || b.is_dyadic() ? 0 : bits_of(a) - bits_of(b);
  if (ahead <= far_ahead) a.refine();
  if (ahead >= -far_ahead) b.refine();
}

}  // namespace

int ExactTime::compare(ExactTime& a, ExactTime& b) {
  if (is_made_from(a, b.polynomial_) && !b.is_dyadic() && !disjoint(a, b)) {
    if (changes_sign_between(a.polynomial_, later_of(a.lower(), b.lower()), earlier_of(a.upper(), b.upper())))
      return 0;
    while (!disjoint(a, b)) refine_both(a, b);
  }
  for (int i = 0; !disjoint(a, b) && !(wants_gcd(a, i) && wants_gcd(b, i)); ++i) {
    if (!wants_gcd(a, i)) a.refine();
    if (!wants_gcd(b, i)) b.refine();
  }
  if (!disjoint(a, b)) {
    if (a.is_dyadic() && b.is_dyadic()) return 0;
    if (a.is_dyadic() || b.is_dyadic()) {
      if (a.is_dyadic() ? is_root(b.polynomial_, a) : is_root(a.polynomial_, b)) return 0;
    } else {
      // The common roots of both polynomials are the roots of g. The times are equal iff g has a root in the
      // overlap, where each polynomial has one root.
      const ExactPolynomial g = ExactPolynomial::gcd(a.polynomial_, b.polynomial_).square_free();
      if (!g.is_constant() &&
          changes_sign_between(g, later_of(a.lower(), b.lower()), earlier_of(a.upper(), b.upper())))
        return 0;
    }
    while (!disjoint(a, b)) refine_both(a, b);
  }
  if (a.root_.upper <= b.root_.lower) return -1;
  return 1;
}

int sign_at(const ExactPolynomial& function, ExactTime& time) {
  if (function.is_zero()) return 0;
  if (function.wide() != nullptr && is_made_from(time, function.square_free())) return 0;
  for (int i = 0; !wants_gcd(time, i); ++i) {
    if (const int sign = sign_all_over(function, time)) return sign;
    time.refine();
  }
  if (time.is_dyadic()) return function.sign_at(time.lower());
  if (is_root(ExactPolynomial::gcd(time.polynomial(), function.square_free()), time)) return 0;
  return sign_after(function, time);
}

namespace {

// Returns the sign of `function` just after its root `time` if no other root is near, else 0. That no root is
// near must be known, or Descartes' rule must prove it for `simple`, the square-free part.
int sign_after_own_root(const ExactPolynomial& function, const ExactPolynomial& simple,
                        const ExactTime& time) {
  if (const WidePolynomial* wide = simple.wide()) {
    if (const auto known = known_roots_around(*wide, time.lower(), time.upper())) {
      const auto& [count, root] = *known;
      if (count != 1) return 0;
      if (root.lower == root.upper) return function.sign_after(root.upper);
      // There is no other root up to this end, which usually has fewer digits than the end of the time's
      // interval.
      if (const int sign = function.sign_at(root.upper)) return sign;
      return function.sign_at(time.upper());
    }
  }
  if (!simple.has_few_roots_between(time.lower(), time.upper())) return 0;
  const int sign = function.sign_at(time.upper());
  if (sign != 0 && simple.wide() != nullptr) {
    // An end of the interval may be another root of the function.
    const int at_lower = simple.sign_at(time.lower());
    if (at_lower != 0 && simple.sign_at(time.upper()) == -at_lower)
      keep_root(*simple.wide(), {time.lower(), time.upper(), 1, at_lower});
  }
  return sign;
}

// Returns the sign at `time` if `function` is known to have no root in its interval. Otherwise returns 0 and
// narrows the time or a known root.
int sign_apart_from_known(const ExactPolynomial& function, const ExactPolynomial& simple, ExactTime& time) {
  const auto known = known_roots_around(*simple.wide(), time.lower(), time.upper());
  if (known && known->count > 0) {
    ExactTime root(simple, known->first);
    refine_both(time, root);
    return 0;
  }
  if (known) {
    for (const Dyadic& end : {time.upper(), time.lower()})
      if (const int sign = function.sign_at(end)) return sign;
  }
  time.refine();
  return 0;
}

}  // namespace

int sign_after(const ExactPolynomial& function, ExactTime& time) {
  if (function.is_zero()) return 0;
  if (time.is_dyadic()) return function.sign_after(time.lower());
  if (function.wide() != nullptr && is_made_from(time, function.square_free())) {
    // There is no other root near, except perhaps at the end of the step.
    while (true) {
      if (const int sign = function.sign_at(time.upper())) return sign;
      time.refine();
      if (time.is_dyadic()) return function.sign_after(time.lower());
    }
  }
  for (int i = 0; !wants_gcd(time, i); ++i) {
    if (const int sign = sign_all_over(function, time)) return sign;
    time.refine();
    if (time.is_dyadic()) return function.sign_after(time.lower());
  }
  const ExactPolynomial simple = function.square_free();
  if (is_root(ExactPolynomial::gcd(time.polynomial(), simple), time)) {
    // Narrow until the time is the only root in the interval.
    while (true) {
      if (const int sign = sign_after_own_root(function, simple, time)) return sign;
      time.refine();
      if (time.is_dyadic()) return function.sign_after(time.lower());
    }
  }
  // While the time has few digits, computing more of them is cheaper than restricting the function to the
  // interval.
  constexpr unsigned few_digits = 1024;
  while (true) {
    const bool exactly =
        time.polynomial().wide() == nullptr || has_digits({time.lower(), time.upper()}, few_digits);
    if (const int sign = sign_all_over(function, time, exactly)) return sign;
    if (simple.wide() == nullptr) {
      time.refine();
    } else if (const int sign = sign_apart_from_known(function, simple, time)) {
      return sign;
    }
    if (time.is_dyadic()) return function.sign_after(time.lower());
  }
}

namespace {

// Returns whether Descartes' rule immediately proves that there is no root between 0 and 1.
bool has_no_changes(const ExactPolynomial& function) {
  const WidePolynomial* wide = function.wide();
  return wide != nullptr ? wide->variations_on(Dyadic(0.0), Dyadic(1.0)).most == 0
                         : function.sign_variations() == 0;
}

}  // namespace

std::optional<ExactFailure> first_failure_after(const ExactPolynomial& function, const ExactTime& now,
                                                TouchPolicy touches) {
  const Dyadic end(1.0);
  if (!(now.upper() < end) || function.is_zero() || has_no_changes(function)) return std::nullopt;
  const bool from_root = now.is_dyadic() && function.sign_at(now.upper()) == 0;
  const ExactPolynomial simple = function.square_free();
  std::optional<ExactFailure> failure;
  bool present = from_root;  // the first root is the present time
  visit_roots(simple, now.upper(), end, [&](RootInterval root) {
    if (std::exchange(present, false)) return true;
    if (root.lower == end) return false;  // events at u = 1 belong to the next step
    ExactTime time(simple, std::move(root));
    // The interval has no other root, so the sign at the upper end decides, unless the function is zero at
    // the end of the step.
    const int at_upper = time.is_dyadic() ? 0 : function.sign_at(time.upper());
    const bool touch = (at_upper != 0 ? at_upper : sign_after(function, time)) > 0;
    if (!touch || touches == TouchPolicy::reported) failure = {std::move(time), touch};
    return !failure;
  });
  return failure;
}

Dyadic dyadic_between(ExactTime& a, ExactTime& b) {
  if (ExactTime::compare(a, b) >= 0) return a.upper();  // the caller's error: nothing lies between
  while (!(a.upper() < b.lower())) {
    if (a.upper() == b.lower() && !a.is_dyadic() && !b.is_dyadic()) return a.upper();
    refine_both(a, b);
  }
  return Dyadic::midpoint(a.upper(), b.lower());
}

Dyadic next_on_grid(ExactTime& time, unsigned bits) {
  for (bool is_first = true;; is_first = false) {
    // The grid has the numbers first, ..., last, times 2^-bits, strictly between the ends.
    const Integer scaled_upper = (time.upper().numerator() << bits) - 1;
    const Integer first = ((time.lower().numerator() << bits) >> time.lower().exponent()) + 1;
    const Integer last = scaled_upper >> time.upper().exponent();
    if (time.is_dyadic() || last < first) return {first, bits};
    if (is_first && last - first > 2) {
      time.narrow_for_doubles();
    } else {
      time.cut_at({(first + last) >> 1, bits});
    }
  }
}

}  // namespace kds
