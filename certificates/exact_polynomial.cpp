#include "certificates/exact_polynomial.h"

#include <algorithm>
#include <cstddef>

#include "certificates/modular_gcd.h"

namespace kds {

namespace {

using Coefficients = std::vector<Integer>;

void drop_leading_zeros(Coefficients& c) {
  while (!c.empty() && c.back() == 0) c.pop_back();
}

// Divides by the content, so that remainder sequences stay small.
void make_primitive(Coefficients& c) {
  Integer content = 0;
  for (const Integer& x : c) {
    content = boost::multiprecision::gcd(content, x);
    if (content == 1) return;
  }
  if (content != 0) {
    for (Integer& x : c) x /= content;
  }
}

// A positive multiple of the remainder of a by b, both without leading zeros, deg a >= deg b.
Coefficients pseudo_remainder(Coefficients a, const Coefficients& b) {
  const Integer lead = abs(b.back());
  const bool negative = b.back() < 0;
  while (a.size() >= b.size()) {
    const Integer factor = negative ? Integer(-a.back()) : a.back();
    const std::size_t shift = a.size() - b.size();
    for (Integer& x : a) x *= lead;
    for (std::size_t i = 0; i < b.size(); ++i) a[i + shift] -= factor * b[i];
    a.pop_back();
    drop_leading_zeros(a);
    make_primitive(a);
  }
  return a;
}

Coefficients polynomial_gcd(Coefficients a, Coefficients b) {
  drop_leading_zeros(a);
  drop_leading_zeros(b);
  if (certainly_coprime(a, b)) return {Integer(1)};
  make_primitive(a);
  make_primitive(b);
  if (a.size() < b.size()) std::swap(a, b);
  while (!b.empty()) {
    Coefficients r = pseudo_remainder(a, b);
    a = std::move(b);
    b = std::move(r);
  }
  return a;
}

// a / b where b divides a over the rationals; the quotient is made primitive.
Coefficients exact_quotient(Coefficients a, const Coefficients& b) {
  if (a.size() < b.size()) return {};
  Coefficients quotient(a.size() - b.size() + 1);
  // Multiplying ahead keeps every step whole.
  Integer ahead = 1;
  for (std::size_t i = 0; i < quotient.size(); ++i) ahead *= b.back();
  for (Integer& x : a) x *= ahead;
  for (std::size_t k = quotient.size(); k-- > 0;) {
    quotient[k] = a[k + b.size() - 1] / b.back();
    for (std::size_t i = 0; i < b.size(); ++i) a[k + i] -= quotient[k] * b[i];
  }
  make_primitive(quotient);
  return quotient;
}

// Coefficients of c(1 + x).
void taylor_shift_by_one(Coefficients& c) {
  for (std::size_t pass = 0; pass + 1 < c.size(); ++pass) {
    for (std::size_t i = c.size() - 1; i-- > pass;) c[i] += c[i + 1];
  }
}

int sign_of(const Integer& x) { return (x > 0) - (x < 0); }

}  // namespace

bool ExactPolynomial::is_zero() const {
  return std::all_of(scaled_.begin(), scaled_.end(), [](const Integer& x) { return x == 0; });
}

bool ExactPolynomial::is_constant() const {
  return scaled_.empty() ||
         std::all_of(scaled_.begin() + 1, scaled_.end(), [](const Integer& x) { return x == 0; });
}

std::size_t ExactPolynomial::largest_bit_length() const {
  std::size_t bits = 0;
  for (const Integer& x : scaled_) {
    if (x != 0) bits = std::max(bits, mpz_sizeinbase(x.backend().data(), 2));
  }
  return bits;
}

int ExactPolynomial::sign_at(const Dyadic& u) const {
  if (scaled_.empty()) return 0;
  const Integer earlier = (Integer(1) << u.exponent()) - u.numerator();
  Integer value = scaled_.back();
  Integer power = 1;
  for (std::size_t k = scaled_.size() - 1; k-- > 0;) {
    power *= earlier;
    value = value * u.numerator() + scaled_[k] * power;
  }
  return sign_of(value);
}

int ExactPolynomial::sign_after(const Dyadic& u) const {
  const ExactPolynomial from_u =
      restricted(u, Dyadic(u.numerator() + (Integer(1) << u.exponent()), u.exponent()));
  for (const Integer& x : from_u.scaled_) {
    if (x != 0) return sign_of(x);
  }
  return 0;
}

int ExactPolynomial::sign_variations() const {
  int variations = 0;
  int last = 0;
  for (const Integer& x : scaled_) {
    const int sign = sign_of(x);
    if (sign == 0) continue;
    if (last != 0 && sign != last) ++variations;
    last = sign;
  }
  return variations;
}

ExactPolynomial ExactPolynomial::restricted(const Dyadic& lower, const Dyadic& upper) const {
  // u = lower (1-s) + upper s and 1-u = (1-lower)(1-s) + (1-upper) s, over a common denominator 2^e.
  const unsigned e = std::max(lower.exponent(), upper.exponent());
  const Integer one = Integer(1) << e;
  const Integer a = lower.numerator() << (e - lower.exponent());
  const Integer b = upper.numerator() << (e - upper.exponent());
  const Integer a1 = one - a;
  const Integer b1 = one - b;

  // Horner in u with the growing power of (1-u), both linear forms in (1-s, s).
  if (scaled_.empty()) return {};
  Coefficients value{scaled_.back()};
  Coefficients power{Integer(1)};
  for (std::size_t k = scaled_.size() - 1; k-- > 0;) {
    const std::size_t size = value.size() + 1;
    Coefficients next_power(size);
    Coefficients next(size);
    for (std::size_t i = 0; i < size; ++i) {
      if (i + 1 < size) next_power[i] += a1 * power[i];
      if (i > 0) next_power[i] += b1 * power[i - 1];
      if (i + 1 < size) next[i] += a * value[i];
      if (i > 0) next[i] += b * value[i - 1];
      next[i] += scaled_[k] * next_power[i];
    }
    value = std::move(next);
    power = std::move(next_power);
  }
  return ExactPolynomial(std::move(value));
}

ExactPolynomial ExactPolynomial::left_half() const {
  // (u, 1-u) = (s/2, (1-s) + s/2): times two, a Taylor shift of the reversed coefficients.
  Coefficients c(scaled_.rbegin(), scaled_.rend());
  taylor_shift_by_one(c);
  for (std::size_t j = 0; j < c.size(); ++j) c[j] <<= j;
  std::reverse(c.begin(), c.end());
  return ExactPolynomial(std::move(c));
}

ExactPolynomial ExactPolynomial::right_half() const {
  Coefficients c = scaled_;
  taylor_shift_by_one(c);
  for (std::size_t j = 0; j < c.size(); ++j) c[j] <<= j;
  return ExactPolynomial(std::move(c));
}

ExactPolynomial ExactPolynomial::square_free() const {
  Coefficients c = scaled_;
  drop_leading_zeros(c);
  if (c.size() <= 2) return ExactPolynomial(std::move(c));
  Coefficients derivative(c.size() - 1);
  for (std::size_t k = 1; k < c.size(); ++k) derivative[k - 1] = c[k] * k;
  if (certainly_coprime(c, derivative)) return ExactPolynomial(std::move(c));
  const Coefficients repeated = polynomial_gcd(c, std::move(derivative));
  if (repeated.size() > 1) {
    c = exact_quotient(std::move(c), repeated);
  } else {
    make_primitive(c);
  }
  return ExactPolynomial(std::move(c));
}

ExactPolynomial ExactPolynomial::gcd(const ExactPolynomial& a, const ExactPolynomial& b) {
  return ExactPolynomial(polynomial_gcd(a.scaled_, b.scaled_));
}

namespace {

// `local` is the polynomial on [lower, upper]. Roots in the open interval, and at `lower` if `with_lower`.
void isolate(ExactPolynomial local, const Dyadic& lower, const Dyadic& upper, bool with_lower,
             std::vector<RootInterval>& roots) {
  if (local.scaled().empty()) return;
  const bool root_at_lower = local.scaled().front() == 0;
  const bool root_at_upper = local.scaled().back() == 0;
  if (root_at_lower && with_lower) roots.push_back({lower, lower});
  const int variations = local.sign_variations();
  if (variations == 0) return;
  if (variations == 1 && !root_at_lower && !root_at_upper) {
    roots.push_back({lower, upper});
    return;
  }
  const Dyadic middle = Dyadic::midpoint(lower, upper);
  isolate(local.left_half(), lower, middle, false, roots);
  isolate(local.right_half(), middle, upper, true, roots);
}

}  // namespace

std::vector<RootInterval> isolate_roots(const ExactPolynomial& square_free, const Dyadic& lower,
                                        const Dyadic& upper) {
  std::vector<RootInterval> roots;
  if (square_free.is_zero()) return roots;
  if (lower == upper) {
    if (square_free.sign_at(lower) == 0) roots.push_back({lower, lower});
    return roots;
  }
  ExactPolynomial local = square_free.restricted(lower, upper);
  const bool root_at_upper = local.scaled().back() == 0;
  isolate(std::move(local), lower, upper, true, roots);
  if (root_at_upper) roots.push_back({upper, upper});
  return roots;
}

}  // namespace kds
