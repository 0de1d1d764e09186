#include "certificates/exact/exact_polynomial.h"

#include <algorithm>
#include <cstddef>
#include <deque>

#include "certificates/exact/modular_gcd.h"

namespace kds {

namespace {

using Integers = std::vector<Integer>;

void drop_leading_zeros(Integers& c) {
  while (!c.empty() && c.back() == 0) c.pop_back();
}

// Divides by the content, so that remainder sequences stay small.
void make_primitive(Integers& c) {
  Integer content = 0;
  for (const Integer& x : c) {
    content = boost::multiprecision::gcd(content, x);
    if (content == 1) return;
  }
  if (content != 0) {
    for (Integer& x : c) x /= content;
  }
}

// Divides out all factors 1 + t, that is (1-u) + u = 1: what a polynomial carries whose degree is written
// higher than it is. They would be repeated roots, and common ones.
void drop_elevation(Integers& c) {
  while (c.size() > 1) {
    Integers quotient(c.size() - 1);
    Integer rest = 0;
    for (std::size_t k = c.size() - 1; k > 0; --k) {
      rest = c[k] - rest;
      quotient[k - 1] = rest;
    }
    if (c[0] != rest) return;
    c = std::move(quotient);
  }
}

// A positive multiple of the remainder of a by b, both without leading zeros, deg a >= deg b.
Integers pseudo_remainder(Integers a, const Integers& b) {
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

Integers polynomial_gcd(Integers a, Integers b) {
  drop_leading_zeros(a);
  drop_leading_zeros(b);
  if (certainly_coprime(a, b)) return {Integer(1)};
  drop_elevation(a);
  drop_elevation(b);
  if (certainly_coprime(a, b)) return {Integer(1)};
  make_primitive(a);
  make_primitive(b);
  if (a.size() < b.size()) std::swap(a, b);
  while (!b.empty()) {
    Integers r = pseudo_remainder(a, b);
    a = std::move(b);
    b = std::move(r);
  }
  return a;
}

// a / b where b divides a over the rationals; the quotient is made primitive.
Integers exact_quotient(Integers a, const Integers& b) {
  if (a.size() < b.size()) return {};
  Integers quotient(a.size() - b.size() + 1);
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

int sign_of(const Integer& x) { return x.sign(); }

int sign_variations_of(const Integers& c) {
  int variations = 0;
  int last = 0;
  for (const Integer& x : c) {
    const int sign = sign_of(x);
    if (sign == 0) continue;
    if (last != 0 && sign != last) ++variations;
    last = sign;
  }
  return variations;
}

void add_product(Integer& sum, const Integer& a, const Integer& b) {
  mpz_addmul(sum.backend().data(), a.backend().data(), b.backend().data());
}

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
  if (u.exponent() == 0 && u.numerator() == 0) return sign_of(scaled_.front());
  const Integer earlier = (Integer(1) << u.exponent()) - u.numerator();
  Integer value = scaled_.back();
  Integer power = 1;
  for (std::size_t k = scaled_.size() - 1; k-- > 0;) {
    power *= earlier;
    value *= u.numerator();
    add_product(value, scaled_[k], power);
  }
  return sign_of(value);
}

int ExactPolynomial::sign_after(const Dyadic& u) const {
  if (const int sign = sign_at(u)) return sign;
  const ExactPolynomial from_u =
      restricted(u, Dyadic(u.numerator() + (Integer(1) << u.exponent()), u.exponent()));
  for (const Integer& x : from_u.scaled_) {
    if (x != 0) return sign_of(x);
  }
  return 0;
}

int ExactPolynomial::sign_variations() const { return sign_variations_of(scaled_); }

ExactPolynomial ExactPolynomial::restricted(const Dyadic& lower, const Dyadic& upper) const {
  if (lower.numerator() == 0 && upper.exponent() == 0 && upper.numerator() == 1) return *this;
  // u = lower (1-s) + upper s and 1-u = (1-lower)(1-s) + (1-upper) s, over a common denominator 2^e.
  const unsigned e = std::max(lower.exponent(), upper.exponent());
  const Integer one = Integer(1) << e;
  const Integer a = lower.numerator() << (e - lower.exponent());
  const Integer b = upper.numerator() << (e - upper.exponent());
  const Integer a1 = one - a;
  const Integer b1 = one - b;

  // Horner in u with the growing power of (1-u), both linear forms in (1-s, s).
  if (scaled_.empty()) return {};
  Integers value(scaled_.size());
  Integers power(scaled_.size());
  value[0] = scaled_.back();
  power[0] = 1;
  for (std::size_t size = 2; size <= scaled_.size(); ++size) {
    const Integer& c = scaled_[scaled_.size() - size];
    for (std::size_t i = size; i-- > 0;) {
      power[i] *= a1;
      value[i] *= a;
      if (i > 0) {
        add_product(power[i], b1, power[i - 1]);
        add_product(value[i], b, value[i - 1]);
      }
      add_product(value[i], c, power[i]);
    }
  }
  return ExactPolynomial(std::move(value));
}

ExactPolynomial ExactPolynomial::square_free() const {
  Integers c = scaled_;
  drop_leading_zeros(c);
  if (c.size() <= 2) return ExactPolynomial(std::move(c));
  if (certainly_square_free(c)) return ExactPolynomial(std::move(c));
  drop_elevation(c);
  if (c.size() <= 2 || certainly_square_free(c)) return ExactPolynomial(std::move(c));
  Integers derivative(c.size() - 1);
  for (std::size_t k = 1; k < c.size(); ++k) derivative[k - 1] = c[k] * k;
  const Integers repeated = polynomial_gcd(c, std::move(derivative));
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

// Degree over k for all k. Products of functions have higher degrees than binomial() takes.
Integers binomials(std::size_t degree) {
  Integers row(degree + 1, Integer(1));
  for (std::size_t k = 1; k < degree; ++k) row[k] = row[k - 1] * (degree - k + 1) / k;
  return row;
}

// Bernstein coefficients proper, times a common multiple of the binomials: these are halved by additions,
// both halves at once.
Integers unscaled(const Integers& scaled) {
  const Integers choose = binomials(scaled.size() - 1);
  Integer multiple = 1;
  for (const Integer& c : choose) multiple = lcm(multiple, c);
  Integers result = scaled;
  for (std::size_t k = 0; k < result.size(); ++k) result[k] *= multiple / choose[k];
  return result;
}

void shift_up(Integer& to, const Integer& from, std::size_t bits) {
  mpz_mul_2exp(to.backend().data(), from.backend().data(), bits);
}

class Isolation {
 public:
  explicit Isolation(const RootVisitor& visit) : visit_(visit) {}

  // `local` is the polynomial on [lower, upper], unscaled, and lost. Roots in the open interval, and at
  // `lower` if `with_lower`; false if the visitor wants no more.
  bool visit(Integers& local, const Dyadic& lower, const Dyadic& upper, bool with_lower,
             std::size_t depth = 0) {
    const bool root_at_lower = local.front() == 0;
    const bool root_at_upper = local.back() == 0;
    if (root_at_lower && with_lower && !visit_({lower, lower})) return false;
    const int variations = sign_variations_of(local);
    if (variations == 0) return true;
    if (variations == 1 && !root_at_lower && !root_at_upper) return visit_({lower, upper});
    const Dyadic middle = Dyadic::midpoint(lower, upper);
    if (left_.size() == depth) left_.emplace_back(local.size());
    halve(local, left_[depth]);
    return visit(left_[depth], lower, middle, false, depth + 1) &&
           visit(local, middle, upper, true, depth + 1);
  }

 private:
  // de Casteljau, times 2^degree; `local` becomes the right half.
  static void halve(Integers& local, Integers& left) {
    const std::size_t degree = local.size() - 1;
    for (std::size_t round = 0; round <= degree; ++round) {
      shift_up(left[round], local[0], degree - round);
      for (std::size_t i = 0; i + round < degree; ++i) local[i] += local[i + 1];
    }
    for (std::size_t i = 1; i <= degree; ++i) shift_up(local[i], local[i], i);
  }

  const RootVisitor& visit_;
  std::deque<Integers> left_;  // one a level, used again
};

}  // namespace

void visit_roots(const ExactPolynomial& square_free, const Dyadic& lower, const Dyadic& upper,
                 const RootVisitor& visit) {
  if (square_free.is_zero()) return;
  if (lower == upper) {
    if (square_free.sign_at(lower) == 0) visit({lower, lower});
    return;
  }
  Integers local = unscaled(square_free.restricted(lower, upper).scaled());
  const bool root_at_upper = local.back() == 0;
  if (Isolation(visit).visit(local, lower, upper, true) && root_at_upper) visit({upper, upper});
}

std::vector<RootInterval> isolate_roots(const ExactPolynomial& square_free, const Dyadic& lower,
                                        const Dyadic& upper) {
  std::vector<RootInterval> roots;
  visit_roots(square_free, lower, upper, [&roots](RootInterval root) {
    roots.push_back(std::move(root));
    return true;
  });
  return roots;
}

}  // namespace kds
