#pragma once
// Random polynomials in scaled Bernstein form with whole coefficients, constructed so that their roots are
// hard to isolate.

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "motions/numbers/exact_number.h"
#include "tests/support/inputs/random.h"

namespace kds::test {

using Scaled = std::vector<Integer>;

inline Scaled product(const Scaled& a, const Scaled& b) {
  Scaled c(a.size() + b.size() - 1);
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) c[i + j] += a[i] * b[j];
  }
  return c;
}

/// q u - p, which has the root p/q.
inline Scaled linear(const Integer& p, const Integer& q) { return {Integer(-p), Integer(q - p)}; }

/// a u^2 + b u + c.
inline Scaled quadratic(const Integer& a, const Integer& b, const Integer& c) {
  return {c, Integer(b + 2 * c), Integer(a + b + c)};
}

/// Returns a random linear factor; more than half of its roots are special values.
inline Scaled random_linear(Random& random) {
  switch (pick(random, 0, 7)) {
    case 0:
      return linear(0, 1);
    case 1:
      return linear(1, 1);
    case 2:
      return linear(1, 2);
    case 3: {  // a root with few bits
      const int bits = pick(random, 1, 6);
      return linear(pick(random, 0, 1 << bits), Integer(1) << bits);
    }
    case 4: {  // a root with the bits of a double, or more
      const auto bits = static_cast<unsigned>(pick(random, 10, 70));
      return linear((Integer(random()) << 6) >> (70 - bits), Integer(1) << bits);
    }
    case 5: {  // a root that is not dyadic
      const int q = 2 * pick(random, 1, 20) + 1;
      return linear(pick(random, -q, 2 * q), q);
    }
    case 6:  // a root outside the step
      return linear(pick(random, -30, 30), pick(random, 1, 9));
    default: {
      const int q = pick(random, 2, 1000);
      return linear(pick(random, 1, q - 1), q);
    }
  }
}

/// Returns a quadratic factor with two irrational roots that are 2^-30 or 2^-60 apart, or without real roots.
inline Scaled random_quadratic(Random& random) {
  switch (pick(random, 0, 3)) {
    case 0: {  // (q u - p)^2 q' - 2^-shift : close irrational roots near p/q
      const Integer q = pick(random, 2, 50);
      const Integer p = pick(random, 0, static_cast<int>(q.get_si()));
      const unsigned shift = random() % 2 ? 60 : 120;
      const Integer s = Integer(1) << shift;
      return quadratic(q * q * s, -2 * p * q * s, p * p * s - pick(random, 1, 3));
    }
    case 1: {  // (q u - p)^2 q' + 2^-shift, which has no real root
      const Integer q = pick(random, 2, 50);
      const Integer p = pick(random, 0, static_cast<int>(q.get_si()));
      const Integer s = Integer(1) << static_cast<unsigned>(pick(random, 0, 100));
      return quadratic(q * q * s, -2 * p * q * s, p * p * s + pick(random, 1, 3));
    }
    case 2:
      return quadratic(pick(random, 1, 30), pick(random, -60, 10), pick(random, -10, 30));
    default:
      return quadratic(2 * pick(random, 1, 9), 0, -pick(random, 1, 9));
  }
}

/// Returns a polynomial with two rational roots 2^-60 apart, or a rational root that close to a dyadic
/// number.
inline Scaled close_pair(Random& random) {
  const Integer s = Integer(1) << 60;
  const Integer q = pick(random, 1, 12);
  const Integer p = pick(random, 0, static_cast<int>(q.get_si()));
  return product(linear(p, q), linear(p * s + pick(random, -1, 1), q * s));
}

inline Scaled random_coefficients(Random& random, int degree, unsigned bits) {
  Scaled p;
  for (int k = 0; k <= degree; ++k) {
    Integer x = random();
    x = bits < 64 ? Integer(x >> (64 - bits)) : Integer(x << (bits - 64));
    p.push_back(random() % 2 ? x : Integer(-x));
  }
  return p;
}

/// Returns Wilkinson's polynomial with the roots 1/(n+1), ..., n/(n+1).
inline Scaled wilkinson(int n) {
  Scaled p{1};
  for (int i = 1; i <= n; ++i) p = product(p, linear(i, n + 1));
  return p;
}

/// Returns a random polynomial of degree at most 18. Two polynomials often have factors in common, which
/// makes equal failure times.
inline Scaled random_polynomial(Random& random) {
  Scaled p{Integer(random() % 2 ? 1 : -1)};
  const auto degree_left = [&] { return 19 - static_cast<int>(p.size()); };
  switch (pick(random, 0, 11)) {
    case 0:
      return random_coefficients(random, pick(random, 1, 18), static_cast<unsigned>(pick(random, 1, 300)));
    case 1:  // many small coefficients, some of them zero
      return random_coefficients(random, pick(random, 1, 18), 1);
    case 2:
      return Scaled(static_cast<std::size_t>(pick(random, 1, 8)), 0);
    case 3:
      p = {Integer(pick(random, -2, 2))};
      break;
    case 4:
      p = product(p, wilkinson(pick(random, 2, 10)));
      break;
    default:
      break;
  }
  const int factors = pick(random, 0, 5);
  for (int i = 0; i < factors && degree_left() >= 6; ++i) {
    const Scaled factor = random() % 3 == 0   ? random_quadratic(random)
                          : random() % 4 == 0 ? close_pair(random)
                                              : random_linear(random);
    const int power = random() % 3 == 0 ? pick(random, 2, 3) : 1;
    for (int j = 0; j < power && degree_left() >= 2; ++j) p = product(p, factor);
  }
  if (degree_left() > 3 && random() % 4 == 0) {
    p = product(p,
                random_coefficients(random, pick(random, 1, 3), static_cast<unsigned>(pick(random, 1, 60))));
  }
  // Raises the degree without changing the polynomial.
  while (degree_left() > 0 && random() % 4 == 0) p = product(p, {1, 1});
  if (random() % 8 == 0) {
    for (Integer& x : p) x <<= 1100;
  }
  return p;
}

/// u^n - 2 (a u - 1)^2, scaled (Mignotte's polynomial): two irrational roots near 1/a, which are closer for
/// larger a and n.
inline Scaled mignotte(int n, int a) {
  Scaled p = product(linear(1, a), linear(1, a));
  while (static_cast<int>(p.size()) <= n) p = product(p, {1, 1});
  for (Integer& x : p) x *= -2;
  p.back() += 1;
  return p;
}

/// Returns a hard polynomial, mostly of degree 6 or less, that a judge decides quickly.
inline Scaled small_polynomial(Random& random) {
  Scaled p{Integer(random() % 2 ? 1 : -1)};
  switch (pick(random, 0, 6)) {
    case 0:
      return random_coefficients(random, pick(random, 1, 6), static_cast<unsigned>(pick(random, 1, 6)));
    case 1:
      return random_coefficients(random, pick(random, 1, 6), static_cast<unsigned>(pick(random, 7, 60)));
    case 2:
      return product(p, mignotte(pick(random, 3, 6), pick(random, 2, 40)));
    case 3:
      p = product(p, close_pair(random));
      break;
    default:
      break;
  }
  for (int factors = pick(random, 1, 3); factors > 0; --factors) {
    const Scaled factor = random() % 3 == 0 ? random_quadratic(random) : random_linear(random);
    for (int power = random() % 3 == 0 ? pick(random, 2, 3) : 1; power > 0 && p.size() <= 6; --power)
      p = product(p, factor);
  }
  if (random() % 4 == 0) p = product(p, {1, 1});  // raises the degree without changing the polynomial
  return p;
}

/// Returns a polynomial that has a factor in common with p.
inline Scaled relative_of(const Scaled& p, Random& random) {
  Scaled q = p;
  if (random() % 2) {
    for (Integer& x : q) x = -3 * x;
  }
  if (q.size() < 16) q = product(q, random() % 2 ? random_linear(random) : random_quadratic(random));
  return q;
}

/// Returns two polynomials with a common root. The second has a further root at most 2^-60 away.
inline std::pair<Scaled, Scaled> close_relatives(Random& random) {
  const Integer s = Integer(1) << 60;
  const Integer q = pick(random, 2, 50);
  const Integer p = pick(random, 0, static_cast<int>(q.get_si()));
  const int change = random() % 2 ? 1 : -1;
  const bool rational = random() % 2 == 0;
  const Scaled common = rational ? linear(p, q) : quadratic(2 * q * q, -4 * p * q, 2 * p * p - 1);
  const Scaled near = rational ? linear(p * s + change, q * s)
                               : quadratic(2 * q * q * s, -4 * p * q * s, (2 * p * p - 1) * s + change);
  return {product(common, random_linear(random)), product(common, near)};
}

inline std::string describe(std::span<const Integer> p) {
  std::string text = "{";
  for (const Integer& x : p) text += (text.size() > 1 ? ", " : "") + x.get_str();
  return text + "}";
}

}  // namespace kds::test
