#pragma once
// An independent judge of roots: Sturm sequences of polynomials in the power basis, evaluated at rational
// numbers. The code is slow and obvious, and uses nothing of certificates/.

#include <cstddef>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include "motions/numbers/exact_number.h"

namespace kds::test::sturm {

/// Coefficients of 1, x, x^2, ..., without leading zeros. The empty polynomial is zero. Coefficients are
/// whole, because a common denominator changes neither roots nor signs.
using Polynomial = std::vector<Integer>;

/// Returns an increasing polynomial whose only root is x.
inline Polynomial with_root(const Rational& x) { return {Integer(-numerator(x)), denominator(x)}; }

inline void trim(Polynomial& p) {
  while (!p.empty() && p.back() == 0) p.pop_back();
}

inline int sign(const Integer& x) { return sgn(x); }

/// Expands sum_k scaled[k] u^k (1-u)^(n-k).
inline Polynomial from_scaled(std::span<const Integer> scaled) {
  Polynomial sum(scaled.size());
  for (std::size_t k = 0; k < scaled.size(); ++k) {
    Polynomial term(scaled.size());
    term[k] = scaled[k];
    for (std::size_t i = k + 1; i < scaled.size(); ++i) {  // times 1-u
      for (std::size_t j = i; j > k; --j) term[j] -= term[j - 1];
    }
    for (std::size_t j = 0; j < scaled.size(); ++j) sum[j] += term[j];
  }
  trim(sum);
  return sum;
}

inline Rational value(const Polynomial& p, const Rational& x) {
  Rational y = 0;
  for (std::size_t k = p.size(); k-- > 0;) y = y * x + p[k];
  return y;
}

inline int sign_at(const Polynomial& p, const Rational& x) {
  const Integer n = numerator(x);
  const Integer d = denominator(x);
  Integer y = 0;
  Integer power = 1;
  for (std::size_t k = p.size(); k-- > 0; power *= d) y = y * n + p[k] * power;
  return sign(y);
}

inline Polynomial derivative(const Polynomial& p) {
  Polynomial d;
  for (std::size_t k = 1; k < p.size(); ++k) d.push_back(p[k] * k);
  return d;
}

/// Multiplies by a positive number so that the coefficients have no common divisor, which keeps remainders
/// small.
inline void normalize(Polynomial& p) {
  trim(p);
  Integer content = 0;
  for (const Integer& x : p) {
    content = gcd(content, x);
    if (content == 1) return;
  }
  for (Integer& x : p) x /= content;
}

/// Returns a positive multiple of the remainder.
inline Polynomial remainder(Polynomial a, const Polynomial& b) {
  if (b.empty()) throw std::logic_error("sturm: division by zero");
  trim(a);
  while (a.size() >= b.size()) {
    const Integer scale = abs(b.back());
    const Integer factor = b.back() < 0 ? Integer(-a.back()) : a.back();
    const std::size_t shift = a.size() - b.size();
    for (Integer& x : a) x *= scale;
    for (std::size_t i = 0; i < b.size(); ++i) a[i + shift] -= factor * b[i];
    trim(a);
  }
  normalize(a);
  return a;
}

/// Returns a positive multiple of a / b, where b divides a.
inline Polynomial quotient(Polynomial a, Polynomial b) {
  if (b.empty()) throw std::logic_error("sturm: division by zero");
  normalize(a);
  normalize(b);  // so that the quotient has whole coefficients, by Gauss's lemma
  Polynomial result(a.size() >= b.size() ? a.size() - b.size() + 1 : 0);
  for (std::size_t k = result.size(); k-- > 0;) {
    result[k] = a[k + b.size() - 1] / b.back();
    for (std::size_t i = 0; i < b.size(); ++i) a[k + i] -= result[k] * b[i];
  }
  trim(a);
  if (!a.empty()) throw std::logic_error("sturm: no divisor");
  return result;
}

inline Polynomial gcd(Polynomial a, Polynomial b) {
  normalize(a);
  normalize(b);
  while (!b.empty()) {
    Polynomial r = remainder(std::move(a), b);
    a = std::move(b);
    b = std::move(r);
  }
  return a;
}

inline Polynomial square_free(const Polynomial& p) {
  if (p.size() <= 2) return p;
  Polynomial result = sturm::quotient(p, sturm::gcd(p, derivative(p)));
  normalize(result);
  return result;
}

/// Counts the distinct roots of a nonzero polynomial.
class Sequence {
 public:
  explicit Sequence(const Polynomial& p) {
    if (p.empty()) throw std::logic_error("sturm: the zero polynomial");
    chain_.push_back(square_free(p));
    Polynomial next = derivative(chain_[0]);
    normalize(next);
    while (!next.empty()) {
      chain_.push_back(std::move(next));
      next = remainder(chain_[chain_.size() - 2], chain_.back());
      for (Integer& x : next) x = -x;
    }
  }

  [[nodiscard]] const Polynomial& square_free_part() const { return chain_[0]; }
  [[nodiscard]] bool is_root(const Rational& x) const { return sign_at(chain_[0], x) == 0; }

  /// Counts the roots in (a, b].
  [[nodiscard]] int roots_after(const Rational& a, const Rational& b) const {
    return a < b ? variations(a) - variations(b) : 0;
  }
  /// Counts the roots in (a, b).
  [[nodiscard]] int roots_between(const Rational& a, const Rational& b) const {
    return a < b ? roots_after(a, b) - int{is_root(b)} : 0;
  }
  /// Counts the roots in [a, b].
  [[nodiscard]] int roots_on(const Rational& a, const Rational& b) const {
    return roots_after(a, b) + int{is_root(a)};
  }

 private:
  [[nodiscard]] int variations(const Rational& x) const {
    int count = 0;
    int last = 0;
    for (const Polynomial& p : chain_) {
      const int s = sign_at(p, x);
      if (s == 0) continue;
      if (last != 0 && s != last) ++count;
      last = s;
    }
    return count;
  }

  std::vector<Polynomial> chain_;
};

/// The only root of a polynomial in (lower, upper]; if lower == upper, the root is that number.
struct Root {
  Rational lower, upper;

  [[nodiscard]] bool is_number() const { return lower == upper; }
};

inline void halve(const Sequence& sequence, Root& root) {
  if (root.is_number()) return;
  if (sequence.is_root(root.upper)) {
    root.lower = root.upper;
    return;
  }
  const Rational middle = (root.lower + root.upper) / 2;
  if (sequence.roots_after(root.lower, middle) == 1) {
    root.upper = middle;
  } else {
    root.lower = middle;
  }
}

/// Returns the distinct roots on [a, b] in ascending order.
inline std::vector<Root> roots_on(const Sequence& sequence, const Rational& a, const Rational& b) {
  std::vector<Root> found;
  if (sequence.is_root(a)) found.push_back({a, a});
  std::vector<Root> open{{a, b}};
  while (!open.empty()) {
    const Root part = open.back();
    open.pop_back();
    const int count = sequence.roots_after(part.lower, part.upper);
    if (count == 0) continue;
    if (count == 1) {
      found.push_back(sequence.is_root(part.upper) ? Root{part.upper, part.upper} : part);
      continue;
    }
    const Rational middle = (part.lower + part.upper) / 2;
    open.push_back({middle, part.upper});
    open.push_back({part.lower, middle});
  }
  return found;
}

/// Returns whether the root of `sequence` is also a root of f.
inline bool shares(const Sequence& sequence, const Root& root, const Polynomial& f) {
  if (f.empty()) return true;
  if (root.is_number()) return sign_at(f, root.upper) == 0;
  if (f.size() == 1) return false;
  const Polynomial common = gcd(sequence.square_free_part(), f);
  return common.size() > 1 && Sequence(common).roots_after(root.lower, root.upper) == 1;
}

/// Returns the multiplicity of the root in f, which is 0 if it is not a root of f.
inline int multiplicity(const Sequence& sequence, const Root& root, Polynomial f) {
  int times = 0;
  while (!f.empty() && shares(sequence, root, f)) {
    ++times;
    f = derivative(f);
  }
  return times;
}

/// Compares two roots; returns -1, 0 or 1.
inline int compare(const Sequence& a, Root x, const Sequence& b, Root y) {
  const auto apart = [&] {
    return x.is_number() && y.is_number() ? x.lower != y.lower
           : x.is_number()                ? x.lower <= y.lower || y.upper < x.upper
           : y.is_number()                ? y.lower <= x.lower || x.upper < y.upper
                                          : x.upper <= y.lower || y.upper <= x.lower;
  };
  const auto equal = [&] {
    if (x.is_number() && y.is_number()) return x.lower == y.lower;
    if (x.is_number()) return y.lower < x.lower && x.lower <= y.upper && b.is_root(x.lower);
    if (y.is_number()) return x.lower < y.lower && y.lower <= x.upper && a.is_root(y.lower);
    const Polynomial common = gcd(a.square_free_part(), b.square_free_part());
    const Rational& lower = x.lower < y.lower ? y.lower : x.lower;
    const Rational& upper = x.upper < y.upper ? x.upper : y.upper;
    return common.size() > 1 && lower < upper && Sequence(common).roots_after(lower, upper) == 1;
  };
  if (!apart() && equal()) return 0;
  while (!apart()) {
    halve(a, x);
    halve(b, y);
  }
  return x.upper < y.upper || (x.upper == y.upper && x.lower < y.lower) ? -1 : 1;
}

/// Returns the sign of f on (x, x + delta).
inline int sign_after(Polynomial f, const Rational& x) {
  while (!f.empty()) {
    if (const int s = sign_at(f, x)) return s;
    f = derivative(f);
  }
  return 0;
}

/// Returns the sign of f just after a root of `sequence`. `own` is the Sturm sequence of f.
inline int sign_after(const Polynomial& f, const Sequence& own, const Sequence& sequence, Root root) {
  const int here = shares(sequence, root, f) ? 1 : 0;
  while (!root.is_number()) {
    if (own.roots_after(root.lower, root.upper) == here && !own.is_root(root.upper) &&
        !sequence.is_root(root.upper))
      return sign_at(f, root.upper);
    halve(sequence, root);
  }
  return sign_after(f, root.upper);
}
inline int sign_after(const Polynomial& f, const Sequence& sequence, const Root& root) {
  return f.empty() ? 0 : sign_after(f, Sequence(f), sequence, root);
}

}  // namespace kds::test::sturm
