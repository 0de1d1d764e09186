#include "certificates/exact/rounded_polynomial.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace kds {

namespace {

constexpr double unit_roundoff = 0x1p-53;
constexpr double inflation = 1 + 0x1p-20;  // for terms in unit_roundoff^2, and rounded comparisons
constexpr double first_error = 4 * unit_roundoff;
constexpr double least_size = 0x1p-800;
constexpr int most_halvings = 52;  // so that the ends of parts are doubles
constexpr int most_parts = 256;

}  // namespace

RoundedPolynomial::RoundedPolynomial(const ExactPolynomial& exact) {
  const std::vector<Integer>& scaled = exact.scaled();
  std::size_t first = 0, last = scaled.size();
  while (first < last && scaled[first] == 0) ++first;
  while (first < last && scaled[last - 1] == 0) --last;
  zero_at_start_ = first > 0;
  zero_at_end_ = last < scaled.size();
  const std::size_t count = last - first;
  whole_.c.resize(count);
  whole_.m.resize(count);
  Coefficients<long> exponent;
  exponent.resize(count);
  long largest = 0;
  for (std::size_t k = 0; k < count; ++k) {
    whole_.c[k] = mpz_get_d_2exp(&exponent[k], scaled[first + k].get_mpz_t());
    largest = std::max(largest, exponent[k]);
  }
  for (std::size_t k = 0; k < count; ++k) {
    const long shift = std::max(exponent[k] - largest, -1000L);
    whole_.c[k] = std::ldexp(whole_.c[k], static_cast<int>(shift)) /
                  static_cast<double>(binomial(static_cast<int>(count) - 1, static_cast<int>(k)));
    // A smaller coefficient still has an error below 4 unit_roundoff times this size.
    whole_.m[k] = std::max(std::abs(whole_.c[k]), least_size);
  }
}

double RoundedPolynomial::Part::width() const { return std::ldexp(1.0, -halvings); }

double RoundedPolynomial::Part::error() const {
  const auto rounds = static_cast<double>(c.size() - 1) * halvings;
  return (first_error + unit_roundoff * rounds) * inflation;
}

auto RoundedPolynomial::Part::halve() -> Part {
  Part right = *this;
  right.lower += 0.5 * width();
  ++halvings;
  ++right.halvings;
  const std::size_t degree = c.size() - 1;
  for (auto [own, others] : {std::pair(&c, &right.c), std::pair(&m, &right.m)}) {
    double* to = others->begin();
    double* left = own->begin();
    for (std::size_t round = 0; round <= degree; ++round) {
      left[round] = to[0];
      for (std::size_t i = 0; i + round < degree; ++i) to[i] = 0.5 * (to[i] + to[i + 1]);
    }
  }
  return right;
}

auto RoundedPolynomial::shape_of(const Part& part) -> Shape {
  const double error = part.error();
  const std::size_t count = part.c.size();
  const auto sign = [&](std::size_t k) {
    const double most = error * part.m[k];
    return part.c[k] > most ? 1 : part.c[k] < -most ? -1 : 0;
  };
  const int first = sign(0), last = sign(count - 1);
  if (first == 0 || last == 0) return Shape::unclear;
  // One uncertain coefficient between two certain ones of opposite sign does not matter: whatever its sign
  // is, there is one sign change.
  int changes = 0, before = first;
  for (std::size_t k = 1, uncertain = 0; k < count; ++k) {
    const int now = sign(k);
    if (now == 0) {
      if (++uncertain > 1) return Shape::unclear;
      continue;
    }
    if (now != before) {
      ++changes;
    } else if (uncertain > 0) {
      return Shape::unclear;
    }
    before = now;
    uncertain = 0;
  }
  if (changes == 0) return first > 0 ? Shape::positive : Shape::unclear;
  if (changes > 1) return Shape::unclear;
  return first > 0 ? Shape::descent : Shape::ascent;
}

auto RoundedPolynomial::value_at(const Part& part, double s) -> Value {
  Coefficients<double> c = part.c, m = part.m;
  const double v = 1 - s;
  const std::size_t degree = c.size() - 1;
  double slope = 0;
  for (std::size_t round = degree; round > 0; --round) {
    if (round == 1) slope = static_cast<double>(degree) * (c[1] - c[0]);
    for (std::size_t i = 0; i < round; ++i) {
      c[i] = v * c[i] + s * c[i + 1];
      m[i] = v * m[i] + s * m[i + 1];
    }
  }
  return {c[0], slope, (part.error() + 4 * unit_roundoff * static_cast<double>(degree) * inflation) * m[0]};
}

int RoundedPolynomial::sign_on(double lower, double upper) const {
  const std::size_t count = whole_.c.size();
  if (count == 0) return 0;
  Value at = value_at(whole_, upper);
  if (lower < upper) {
    double steepest = 0;
    for (std::size_t k = 0; k + 1 < count; ++k)
      steepest = std::max(
          steepest, std::abs(whole_.c[k + 1] - whole_.c[k]) + first_error * (whole_.m[k] + whole_.m[k + 1]));
    at.error += static_cast<double>(count - 1) * steepest * (upper - lower) * inflation;
  }
  return at.value > at.error ? 1 : at.value < -at.error ? -1 : 0;
}

auto RoundedPolynomial::first_descent(double from) const -> Result {
  if (whole_.c.size() == 0) return {Verdict::undecided, {}};
  if (whole_.c.size() == 1) return {whole_.c[0] > 0 ? Verdict::never : Verdict::undecided, {}};
  std::vector<Part> waiting;
  Part part = whole_;
  for (int parts = 0; parts < most_parts; ++parts) {
    if (from < part.upper()) {
      const Shape shape = shape_of(part);
      if (shape == Shape::descent) {
        // If `from` is inside, the root is after it.
        if (const auto descent = narrowed(part, from)) return {Verdict::found, *descent};
        return {Verdict::undecided, {}};
      }
      // An ascent has its root before `from`: a root after `from` would follow a descent, and that comes
      // first.
      const bool done = shape == Shape::positive || (shape == Shape::ascent && part.lower < from);
      if (!done) {
        if (part.halvings == most_halvings) return {Verdict::undecided, {}};
        waiting.push_back(part.halve());
        continue;
      }
    }
    if (waiting.empty()) return {Verdict::never, {}};
    part = std::move(waiting.back());
    waiting.pop_back();
  }
  return {Verdict::undecided, {}};
}

/// Narrows by Newton's steps between points with certain signs, then moves the ends as close as their signs
/// stay certain.
auto RoundedPolynomial::narrowed(const Part& part, double from) const -> std::optional<Descent> {
  const double width = part.width();
  const double scale = std::ldexp(1.0, part.halvings);
  const auto in_part = [&](double time) { return (time - part.lower) * scale; };  // exact
  double lower = std::max(part.lower, from), upper = part.upper();
  const std::size_t degree = part.c.size() - 1;
  std::size_t k = 0;
  while (k + 1 < degree && part.c[k + 1] > 0) ++k;
  double low = in_part(lower), high = 1;
  double s = (static_cast<double>(k) + part.c[k] / (part.c[k] - part.c[k + 1])) / static_cast<double>(degree);
  s = std::clamp(s, low, high);
  Value at = value_at(part, s);
  for (int step = 0; step < 60 && std::abs(at.value) > at.error; ++step) {
    (at.value > 0 ? low : high) = s;
    double next = s - at.value / at.slope;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    const bool near = std::abs(next - s) <= 0x1p-52 * next;
    s = next;
    at = value_at(part, s);
    if (near) break;
  }
  const double root = part.lower + s * width;
  double reach = std::max(4 * at.error / std::abs(at.slope) * width, root * 0x1p-52);
  bool below = true, above = true;
  for (int attempt = 0; attempt < 8 && (below || above); ++attempt, reach *= 16) {
    if (below && root - reach > lower) {
      const Value left = value_at(part, in_part(root - reach));
      if (left.value > left.error) {
        lower = root - reach;
        below = false;
      }
    }
    if (above && root + reach < upper) {
      const Value right = value_at(part, in_part(root + reach));
      if (right.value < -right.error) {
        upper = root + reach;
        above = false;
      }
    }
  }
  // The function itself is zero at these ends.
  if ((zero_at_start_ && lower == 0) || (zero_at_end_ && upper == 1)) return std::nullopt;
  return Descent{lower, upper, part.upper() == 1 && !zero_at_end_};
}

}  // namespace kds
