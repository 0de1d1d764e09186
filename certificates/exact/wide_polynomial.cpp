#include "certificates/exact/wide_polynomial.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <utility>

#include "certificates/exact/polynomial_gcd.h"

namespace kds {

namespace {

/// The highest precision at which coefficients are rounded to a power of two and kept.
constexpr std::size_t most_kept_bits = 2048;

/// Returns whether `digits` correct leading bits suffice. Each coefficient must either have as many correct
/// bits itself, or be negligible everywhere in (0,1). A coefficient is negligible if it lies `digits` bits
/// below the Newton polygon: one coefficient before it and one after it have enough correct bits and outweigh
/// it.
bool suffice(const std::vector<BallNumber>& c, std::size_t digits) {
  struct Corner {
    std::int64_t index, top;
    /// Returns whether this corner is on or below the line through the two others.
    [[nodiscard]] bool is_below(const Corner& from, const Corner& to) const {
      return (top - from.top) * (to.index - from.index) <= (to.top - from.top) * (index - from.index);
    }
  };
  std::vector<Corner> polygon, doubtful;
  for (std::size_t k = 0; k < c.size(); ++k) {
    const Corner corner{static_cast<std::int64_t>(k), c[k].top_bit()};
    if (!c[k].has_digits(digits)) {
      doubtful.push_back({corner.index, corner.top + static_cast<std::int64_t>(digits)});
    } else if (!c[k].is_zero()) {
      while (polygon.size() > 1 && polygon.back().is_below(polygon[polygon.size() - 2], corner))
        polygon.pop_back();
      polygon.push_back(corner);
    }
  }
  return std::all_of(doubtful.begin(), doubtful.end(), [&](const Corner& x) {
    const auto after =
        std::find_if(polygon.begin(), polygon.end(), [&](const Corner& y) { return y.index > x.index; });
    return after != polygon.begin() && after != polygon.end() && x.is_below(*(after - 1), *after);
  });
}

template <class Number>
std::vector<Number> negatives_of(const std::vector<Number>& numbers) {
  std::vector<Number> negatives;
  negatives.reserve(numbers.size());
  for (const Number& x : numbers) negatives.push_back(-x);
  return negatives;
}

/// Returns the precision in which `bits` bits are computed.
std::size_t precision_of(std::size_t bits) {
  return bits <= most_kept_bits ? std::bit_ceil(std::max(bits, BallNumber::first_bits)) : bits;
}

/// Returns the polynomial restricted to an interval, in numbers of `bits` bits.
std::vector<BallNumber> seen_in(std::size_t bits, const WidePolynomial& polynomial,
                                const detail::Ends& ends) {
  return detail::seen_on(polynomial.balls(bits), BallNumber(1, bits), BallNumber(ends.lower, bits),
                         BallNumber(ends.upper, bits), BallNumber(ends.above_lower, bits),
                         BallNumber(ends.above_upper, bits));
}

/// Returns the sign on an interval if numbers of `bits` bits decide it, else 0.
int sign_in(std::size_t bits, const WidePolynomial& polynomial, const detail::Ends& ends) {
  return detail::value_of(polynomial.balls(bits), BallNumber(1, bits),
                          BallNumber::between(ends.lower, ends.upper, bits),
                          BallNumber::between(ends.above_upper, ends.above_lower, bits))
      .certain_sign();
}

/// Calls `answer` with more and more bits until it returns a result, finally without a limit.
template <class Answer>
auto to_enough_bits(std::size_t bits, std::size_t all, Answer answer) {
  for (; bits < all; bits *= 2)
    if (auto found = answer(precision_of(bits))) return std::move(*found);
  return std::move(*answer(BallNumber::unlimited));
}

std::size_t bits_at(const WidePolynomial& polynomial, unsigned exponent) {
  return polynomial.largest_bit_length() + exponent * (polynomial.size() - 1);
}

/// Returns how many binary digits both ends have in common, measured from 0 or 1, whichever is nearer.
std::size_t digits_of(const detail::Ends& ends) {
  const std::size_t bits = std::min(bit_length(ends.upper), bit_length(ends.above_lower));
  return bits - std::min(bits, bit_length(ends.upper - ends.lower));
}

bool is_enough(const Variations& v) { return v.least == v.most || v.least >= 2; }

}  // namespace

const std::vector<Integer>& WidePolynomial::whole() const {
  if (!whole_) whole_ = opposite_ ? negatives_of(opposite_->whole()) : source_->whole();
  return *whole_;
}

const std::vector<BallNumber>& WidePolynomial::balls(std::size_t bits) const {
  if (const auto known = balls_.find(bits); known != balls_.end()) return known->second;
  // Keep the balls only when complete: forming them may throw.
  std::vector<BallNumber> balls;
  if (opposite_) {
    balls = negatives_of(opposite_->balls(bits));
  } else if (const std::vector<BallNumber>* formed = bits <= most_kept_bits ? formed_to(bits / 2) : nullptr) {
    for (const BallNumber& x : *formed) balls.push_back(x.rounded(bits));
  } else {
    for (const Integer& x : whole()) balls.emplace_back(x, bits);
  }
  balls_.erase(balls_.upper_bound(most_kept_bits), balls_.end());
  return balls_[bits] = std::move(balls);
}

const std::vector<BallNumber>* WidePolynomial::formed_to(std::size_t bits) const {
  if (whole_) return nullptr;
  if (formed_bits_ != 0 && suffice(formed_, bits)) return &formed_;
  for (const std::size_t precision : CoefficientSource::precisions) {
    // If nearly all digits of the terms cancel, form the coefficients more precisely.
    if (precision <= formed_bits_ || precision < bits) continue;
    formed_ = source_->balls(precision);
    formed_bits_ = precision;
    if (suffice(formed_, bits)) return &formed_;
  }
  return nullptr;
}

const std::vector<Residue>& WidePolynomial::residues() const {
  if (!residues_)
    residues_ = opposite_ ? negatives_of(opposite_->residues())
                : whole_  ? image_of(*whole_)
                          : source_->residues(residue_folds[0]);
  return *residues_;
}

std::size_t WidePolynomial::largest_bit_length() const {
  std::int64_t bits = 0;
  for (const BallNumber& x : balls()) {
    if (!x.is_zero()) bits = std::max(bits, x.top_bit());
  }
  return static_cast<std::size_t>(bits);
}

bool WidePolynomial::is_zero() const {
  bool zero = true;
  for (const BallNumber& x : balls()) {
    if (x.certain_sign() != 0) return false;
    zero &= x.is_zero();
  }
  return zero || std::all_of(whole().begin(), whole().end(), [](const Integer& x) { return x == 0; });
}

int WidePolynomial::first_sign() const {
  for (const BallNumber& x : balls()) {
    if (const int sign = x.certain_sign()) return sign;
    if (!x.is_zero()) break;
  }
  for (const Integer& x : whole()) {
    if (x != 0) return sgn(x);
  }
  return 0;
}

int WidePolynomial::sign_at(const Dyadic& u) const {
  if (balls().empty()) return 0;
  if (u.exponent() == 0 && u.numerator() == 0) {
    const BallNumber& first = balls().front();
    return first.certain_sign() != 0 || first.is_zero() ? first.certain_sign() : sgn(whole().front());
  }
  return value_at(*this, u, 1).certain_sign();
}

int WidePolynomial::sign_on(const Dyadic& lower, const Dyadic& upper) const {
  return balls().empty() ? 0 : sign_in(BallNumber::first_bits, *this, detail::Ends(lower, upper));
}

int WidePolynomial::sign_variations() const {
  const Variations rough = detail::variations_of(balls(), std::nullopt, std::nullopt);
  return rough.least == rough.most ? rough.least : detail::sign_variations_of(whole());
}

Variations WidePolynomial::variations_on(const Dyadic& lower, const Dyadic& upper,
                                         std::optional<int> sign_at_lower,
                                         std::optional<int> sign_at_upper) const {
  if (balls().empty() || (lower.numerator() == 0 && upper == Dyadic(1.0)))
    return detail::variations_of(balls(), sign_at_lower, sign_at_upper);
  return detail::variations_of(seen_in(BallNumber::first_bits, *this, detail::Ends(lower, upper)),
                               sign_at_lower, sign_at_upper);
}

BallNumber value_at(const WidePolynomial& polynomial, const Dyadic& u, std::size_t digits) {
  const std::size_t degree = polynomial.size() - 1;
  const Integer later = u.numerator(), earlier = (Integer(1) << u.exponent()) - u.numerator();
  const auto in = [&](std::size_t bits) -> std::optional<BallNumber> {
    BallNumber value = detail::value_of(polynomial.balls(bits), BallNumber(1, bits), BallNumber(later, bits),
                                        BallNumber(earlier, bits));
    return bits == BallNumber::unlimited || value.has_digits(digits) ? std::optional(std::move(value))
                                                                     : std::nullopt;
  };
  std::optional<BallNumber> value = in(BallNumber::first_bits);
  if (!value)
    value = to_enough_bits(std::max<std::size_t>(256, 2 * digits), bits_at(polynomial, u.exponent()) / 2, in);
  value->scale(-static_cast<std::int64_t>(u.exponent()) * static_cast<std::int64_t>(degree));
  return std::move(*value);
}

int sign_closely(const WidePolynomial& polynomial, const Dyadic& lower, const Dyadic& upper) {
  const detail::Ends ends(lower, upper);
  // Bits far below the interval's own uncertainty cannot help to decide the sign.
  constexpr std::size_t spare_bits = 128;
  return sign_in(precision_of(digits_of(ends) + spare_bits), polynomial, ends);
}

Halves seen_closely(const WidePolynomial& polynomial, const Dyadic& lower, const Dyadic& upper,
                    std::size_t bits) {
  const detail::Ends ends(lower, upper);
  const bool all = bits >= bits_at(polynomial, ends.exponent) / 2;
  const std::vector<BallNumber> seen =
      seen_in(all ? BallNumber::unlimited : precision_of(bits), polynomial, ends);
  // Choose a unit slightly smaller than the largest error.
  constexpr std::int64_t spare_bits = 8;
  std::optional<std::int64_t> unit;
  for (const BallNumber& x : seen)
    if (const auto level = x.radius_bit())
      unit = std::max(unit.value_or(*level - spare_bits), *level - spare_bits);
  if (!unit)
    for (const BallNumber& x : seen)
      if (!x.is_zero()) unit = std::min(unit.value_or(x.lowest_bit()), x.lowest_bit());
  std::vector<Integer> scaled;
  Integer error = 0;
  for (const BallNumber& x : seen) scaled.push_back(x.in_units(unit.value_or(0), error));
  return {scaled, error};
}

Variations variations_closely(const WidePolynomial& polynomial, const Dyadic& lower, const Dyadic& upper,
                              std::size_t& bits) {
  const detail::Ends ends(lower, upper);
  const std::size_t first = bits;
  std::size_t tried = 0;
  return to_enough_bits(
      first, bits_at(polynomial, ends.exponent) / 2, [&](std::size_t precision) -> std::optional<Variations> {
        bits = first << tried++;
        const Variations v =
            detail::variations_of(seen_in(precision, polynomial, ends), std::nullopt, std::nullopt);
        return is_enough(v) || precision == BallNumber::unlimited ? std::optional(v) : std::nullopt;
      });
}

Variations exact_variations(const WidePolynomial& polynomial, const Dyadic& lower, const Dyadic& upper) {
  if (const Variations rough = polynomial.variations_on(lower, upper); is_enough(rough)) return rough;
  // Numbers with fewer digits cannot distinguish the ends.
  std::size_t bits = std::bit_ceil(std::max<std::size_t>(256, digits_of(detail::Ends(lower, upper))));
  return variations_closely(polynomial, lower, upper, bits);
}

}  // namespace kds
