#include "certificates/exact/time_span.h"

#include <optional>
#include <utility>
#include <vector>

namespace kds {

namespace {

/// The affine map from a step's parameter to that of another step with the same reading, u -> offset + rate
/// u.
struct AffineMap {
  Rational offset, rate;  // rate > 0

  [[nodiscard]] Rational at(const Rational& u) const { return offset + rate * u; }
  [[nodiscard]] Rational back(const Rational& v) const { return (v - offset) / rate; }
};

std::vector<Integer> product(const std::vector<Integer>& a, const std::vector<Integer>& b) {
  std::vector<Integer> c(a.size() + b.size() - 1);
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j) c[i + j] += a[i] * b[j];
  return c;
}

/// Returns the polynomial p(a + (b - a) v) in v, times a positive number, in scaled Bernstein form. The form
/// is homogeneous in v and 1 - v, so u = a (1 - v) + b v and 1 - u = (1 - a) (1 - v) + (1 - b) v are
/// substituted.
ExactPolynomial between(const ExactPolynomial& p, const Rational& a, const Rational& b) {
  Integer unit;
  mpz_lcm(unit.get_mpz_t(), a.get_den_mpz_t(), b.get_den_mpz_t());
  const Integer first = a.get_num() * (unit / a.get_den()), second = b.get_num() * (unit / b.get_den());
  const std::vector<Integer> u{first, second}, rest{unit - first, unit - second};
  const std::vector<Integer>& c = p.scaled();
  std::vector<Integer> sum{c.back()}, power{1};  // Horner's rule in u and 1 - u
  for (std::size_t k = c.size() - 1; k-- > 0;) {
    power = product(power, rest);
    sum = product(sum, u);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += c[k] * power[i];
  }
  return ExactPolynomial(std::move(sum));
}

/// Returns a dyadic number between two rational numbers, low < high, with few digits.
Dyadic dyadic_in(const Rational& low, const Rational& high) {
  const Rational room = high - low;
  unsigned bits = 0;
  for (Rational step(1); step >= room; step /= 2) ++bits;
  Integer below = numerator(low) << bits;
  mpz_fdiv_q(below.get_mpz_t(), below.get_mpz_t(), low.get_den_mpz_t());
  return {below + 1, bits};  // in (low, low + 2^-bits], and 2^-bits < room
}

/// Returns the image of an irrational time as a root on [0, 1], or nothing if the time proves to be dyadic.
/// The image of the time's interval must lie in [0, 1].
std::optional<ExactTime> image(const ExactTime& time, const AffineMap& map) {
  ExactTime inner = time;
  while (!inner.is_dyadic() && (inner.lower() == time.lower() || inner.upper() == time.upper()))
    inner.refine();
  if (inner.is_dyadic()) return std::nullopt;
  const auto of = [&map](const Dyadic& u) { return map.at(u.rational()); };
  return ExactTime(between(time.polynomial(), map.back(Rational(0)), map.back(Rational(1))),
                   RootInterval{dyadic_in(of(time.lower()), of(inner.lower())),
                                dyadic_in(of(inner.upper()), of(time.upper()))});
}

}  // namespace

int compare_with(ExactTime& time, const Rational& point) {
  if (time.is_dyadic()) return sgn(Rational(time.lower().rational() - point));
  if (point <= time.lower().rational()) return 1;
  if (point >= time.upper().rational()) return -1;
  const Integer p = numerator(point), q = denominator(point);
  ExactTime there(ExactPolynomial({p, p - q}), RootInterval{Dyadic(0.0), Dyadic(1.0)});
  return ExactTime::compare(time, there);
}

int compare_span(ExactTime& earlier, const StepClock& earlier_clock, ExactTime& later,
                 const StepClock& later_clock, double length) {
  const Rational begin(earlier_clock.begin), long_step = Rational(earlier_clock.end) - begin;
  const AffineMap map{(Rational(later_clock.begin) - Rational(length) - begin) / long_step,
                      (Rational(later_clock.end) - Rational(later_clock.begin)) / long_step};
  // Compares the image of `later` with `earlier`, both as parameters of the earlier step.
  constexpr int narrowings = 4;  // nearly all pairs that differ are apart then
  for (int i = 0; i < narrowings; ++i) {
    if (later.is_dyadic()) return -compare_with(earlier, map.at(later.lower().rational()));
    if (earlier.is_dyadic()) return compare_with(later, map.back(earlier.lower().rational()));
    if (map.at(later.lower().rational()) >= earlier.upper().rational()) return 1;
    if (map.at(later.upper().rational()) <= earlier.lower().rational()) return -1;
    if (i == 0) {
      earlier.narrow_for_doubles();
      later.narrow_for_doubles();
    } else {
      earlier.refine();
      later.refine();
    }
  }
  // An irrational `earlier` lies strictly between 0 and 1.
  if (compare_with(later, map.back(Rational(0))) <= 0) return -1;
  if (compare_with(later, map.back(Rational(1))) >= 0) return 1;
  while (!later.is_dyadic() && (map.at(later.lower().rational()) < 0 || map.at(later.upper().rational()) > 1))
    later.refine();
  if (!later.is_dyadic())
    if (auto there = image(later, map)) return ExactTime::compare(*there, earlier);
  while (!later.is_dyadic()) later.refine();
  return -compare_with(earlier, map.at(later.lower().rational()));
}

}  // namespace kds
