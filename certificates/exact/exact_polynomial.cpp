#include "certificates/exact/exact_polynomial.h"

#include <algorithm>
#include <cstddef>
#include <optional>

#include "certificates/exact/bernstein_parts.h"
#include "certificates/exact/modular_gcd.h"
#include "certificates/exact/precise_values.h"

namespace kds {

namespace {

using detail::Ends;
using detail::seen_on;
using detail::value_of;
using detail::variations_of;
using Integers = std::vector<Integer>;
using Enclosures = std::vector<Enclosure>;

void drop_leading_zeros(Integers& c) {
  while (!c.empty() && c.back() == 0) c.pop_back();
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

}  // namespace

struct ExactPolynomial::State {
  std::unique_ptr<const CoefficientSource> source;
  std::optional<Integers> whole;
  std::optional<Enclosures> leading;
  std::optional<ExactPolynomial> square_free;  ///< unless it is this one
  bool is_square_free = false;
  std::optional<std::vector<RootInterval>> isolated;
};

std::optional<std::vector<RootInterval>>& ExactPolynomial::isolated() const { return state_->isolated; }

ExactPolynomial::ExactPolynomial() : ExactPolynomial(std::vector<Integer>()) {}

ExactPolynomial::ExactPolynomial(std::vector<Integer> scaled) : state_(std::make_shared<State>()) {
  state_->whole = std::move(scaled);
}

ExactPolynomial::ExactPolynomial(std::unique_ptr<const CoefficientSource> source)
    : state_(std::make_shared<State>()) {
  state_->source = std::move(source);
}

const std::vector<Integer>& ExactPolynomial::scaled() const {
  if (!state_->whole) state_->whole = state_->source->whole();
  return *state_->whole;
}

const std::vector<Enclosure>& ExactPolynomial::leading_digits() const {
  if (!state_->leading) {
    if (state_->whole) {
      state_->leading.emplace();
      for (const Integer& x : *state_->whole) state_->leading->push_back(Enclosure::of(x));
    } else {
      state_->leading = state_->source->leading_digits();
    }
  }
  return *state_->leading;
}

std::vector<Residue> ExactPolynomial::residues() const {
  return state_->whole ? image_of(*state_->whole) : state_->source->residues(residue_folds[0]);
}

bool ExactPolynomial::is_zero() const {
  bool zero = true;
  for (const Enclosure& x : leading_digits()) {
    if (x.certain_sign() != 0) return false;
    zero &= x.is_zero();
  }
  return zero || std::all_of(scaled().begin(), scaled().end(), [](const Integer& x) { return x == 0; });
}

bool ExactPolynomial::is_constant() const {
  const Enclosures& c = leading_digits();
  if (c.empty()) return true;
  if (std::any_of(c.begin() + 1, c.end(), [](const Enclosure& x) { return x.certain_sign() != 0; }))
    return false;
  return std::all_of(scaled().begin() + 1, scaled().end(), [](const Integer& x) { return x == 0; });
}

std::size_t ExactPolynomial::largest_bit_length() const {
  std::int64_t bits = 0;
  for (const Enclosure& x : leading_digits()) {
    if (!x.is_zero()) bits = std::max(bits, x.top_bit());
  }
  return static_cast<std::size_t>(bits);
}

int ExactPolynomial::sign_at(const Dyadic& u) const {
  const Enclosures& leading = leading_digits();
  if (leading.empty()) return 0;
  if (u.exponent() == 0 && u.numerator() == 0) {
    const Enclosure& first = leading.front();
    return first.certain_sign() != 0 || first.is_zero() ? first.certain_sign() : sign_of(scaled().front());
  }
  const Enclosure rough = value_of(leading, Enclosure::of(1), Enclosure::of(u.numerator()),
                                   Enclosure::of((Integer(1) << u.exponent()) - u.numerator()));
  if (const int sign = rough.certain_sign(); sign != 0 || rough.is_zero()) return sign;
  return value_at(*this, u, 1).certain_sign();
}

int ExactPolynomial::sign_after(const Dyadic& u) const {
  if (const int sign = sign_at(u)) return sign;
  const ExactPolynomial from_u =
      restricted(u, Dyadic(u.numerator() + (Integer(1) << u.exponent()), u.exponent()));
  for (const Integer& x : from_u.scaled()) {
    if (x != 0) return sign_of(x);
  }
  return 0;
}

int ExactPolynomial::sign_variations() const {
  const Variations rough = variations_of(leading_digits(), std::nullopt, std::nullopt);
  return rough.least == rough.most ? rough.least : sign_variations_of(scaled());
}

namespace {

Enclosures seen_on(const Enclosures& c, const Dyadic& lower, const Dyadic& upper) {
  if (c.empty() || (lower.numerator() == 0 && upper == Dyadic(1.0))) return c;
  const Ends ends(lower, upper);
  return seen_on(c, Enclosure::of(1), Enclosure::of(ends.lower), Enclosure::of(ends.upper),
                 Enclosure::of(ends.above_lower), Enclosure::of(ends.above_upper));
}

}  // namespace

Variations ExactPolynomial::variations_on(const Dyadic& lower, const Dyadic& upper) const {
  return variations_of(seen_on(leading_digits(), lower, upper), std::nullopt, std::nullopt);
}

Variations ExactPolynomial::variations_on(const Dyadic& lower, const Dyadic& upper, int sign_at_lower,
                                          int sign_at_upper) const {
  return variations_of(seen_on(leading_digits(), lower, upper), sign_at_lower, sign_at_upper);
}

ExactPolynomial ExactPolynomial::restricted(const Dyadic& lower, const Dyadic& upper) const {
  if (lower.numerator() == 0 && upper.exponent() == 0 && upper.numerator() == 1) return *this;
  if (scaled().empty()) return {};
  const Ends ends(lower, upper);
  return ExactPolynomial(
      seen_on(scaled(), Integer(1), ends.lower, ends.upper, ends.above_lower, ends.above_upper));
}

ExactPolynomial ExactPolynomial::square_free() const {
  State& state = *state_;
  if (state.is_square_free) return *this;
  if (state.square_free) return *state.square_free;
  if (certainly_square_free(residues())) {
    state.is_square_free = true;
    return *this;
  }
  Integers c = scaled();
  drop_leading_zeros(c);
  if (c.size() > 2 && !certainly_square_free(c)) {
    drop_elevation(c);
    if (c.size() > 2 && !certainly_square_free(c)) {
      Integers derivative(c.size() - 1);
      for (std::size_t k = 1; k < c.size(); ++k) derivative[k - 1] = c[k] * k;
      make_primitive(c);
      if (const Integers repeated = polynomial_gcd(c, std::move(derivative)); repeated.size() > 1)
        c = quotient(std::move(c), repeated).value();
    }
  }
  ExactPolynomial simple(std::move(c));
  simple.state_->is_square_free = true;
  state.square_free = simple;
  return simple;
}

ExactPolynomial ExactPolynomial::gcd(const ExactPolynomial& a, const ExactPolynomial& b) {
  if (a.state_ == b.state_) return a;
  if (certainly_coprime(a.residues(), b.residues())) return ExactPolynomial({Integer(1)});
  const auto without_elevation = [](const ExactPolynomial& p) {
    Integers c = p.scaled();
    drop_leading_zeros(c);
    drop_elevation(c);
    return c;
  };
  return ExactPolynomial(polynomial_gcd(without_elevation(a), without_elevation(b)));
}

}  // namespace kds
