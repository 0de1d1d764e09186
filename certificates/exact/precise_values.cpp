#include "certificates/exact/precise_values.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <utility>
#include <vector>

#include "certificates/exact/bernstein_parts.h"

namespace kds {

namespace {

using Longs = std::vector<LongDigits>;

Longs cut(const std::vector<Integer>& c, std::size_t bits) {
  Longs result;
  result.reserve(c.size());
  for (const Integer& x : c) result.emplace_back(x, bits);
  return result;
}

/// Calls `answer(bits)` for more and more bits, until it has one; at last without a limit.
template <class Answer>
auto to_enough_bits(std::size_t bits, std::size_t all, Answer answer) {
  for (; bits < all; bits *= 2) {
    if (auto found = answer(bits)) return std::move(*found);
  }
  return std::move(*answer(LongDigits::unlimited));
}

std::size_t bits_at(const WidePolynomial& polynomial, unsigned exponent) {
  return polynomial.largest_bit_length() + exponent * (polynomial.size() - 1);
}

}  // namespace

LongDigits value_at(const WidePolynomial& polynomial, const Dyadic& u, std::size_t digits) {
  const std::size_t degree = polynomial.size() - 1;
  const Integer later = u.numerator(), earlier = (Integer(1) << u.exponent()) - u.numerator();
  LongDigits value(detail::value_of(polynomial.leading_digits(), LeadingDigits::of(1),
                                    LeadingDigits::of(later), LeadingDigits::of(earlier)));
  if (!value.has_digits(digits)) {
    value = to_enough_bits(
        std::max<std::size_t>(256, 2 * digits), bits_at(polynomial, u.exponent()) / 2,
        [&](std::size_t bits) -> std::optional<LongDigits> {
          LongDigits at_u = detail::value_of(cut(polynomial.whole(), bits), LongDigits(1, bits),
                                             LongDigits(later, bits), LongDigits(earlier, bits));
          return bits == LongDigits::unlimited || at_u.has_digits(digits) ? std::optional(std::move(at_u))
                                                                          : std::nullopt;
        });
  }
  value.scale(-static_cast<std::int64_t>(u.exponent()) * static_cast<std::int64_t>(degree));
  return value;
}

int sign_closely(const WidePolynomial& polynomial, const Dyadic& lower, const Dyadic& upper) {
  const detail::Ends ends(lower, upper);
  const auto width_of = [](const Integer& x) { return mpz_sizeinbase(x.data(), 2); };
  const std::size_t places = std::min(width_of(ends.upper), width_of(ends.above_lower));
  const std::size_t digits = places - std::min(places, width_of(ends.upper - ends.lower));
  // Bits far below what the interval leaves open tell nothing.
  constexpr std::size_t spare_bits = 128;
  const std::size_t bits = digits + spare_bits;
  return detail::value_of(cut(polynomial.whole(), bits), LongDigits(1, bits),
                          LongDigits::between(ends.lower, ends.upper, bits),
                          LongDigits::between(ends.above_upper, ends.above_lower, bits))
      .certain_sign();
}

Halves seen_closely(const WidePolynomial& polynomial, const Dyadic& lower, const Dyadic& upper,
                    std::size_t bits) {
  const detail::Ends ends(lower, upper);
  if (bits >= bits_at(polynomial, ends.exponent) / 2) bits = LongDigits::unlimited;
  const Longs seen = detail::seen_on(cut(polynomial.whole(), bits), LongDigits(1, bits),
                                     LongDigits(ends.lower, bits), LongDigits(ends.upper, bits),
                                     LongDigits(ends.above_lower, bits), LongDigits(ends.above_upper, bits));
  // In units of what the worst of them is wrong by, a little less.
  constexpr std::int64_t spare_bits = 8;
  std::optional<std::int64_t> unit;
  for (const LongDigits& x : seen) {
    if (x.error() != 0) {
      const std::int64_t level = x.exponent() + static_cast<int>(std::bit_width(x.error())) - spare_bits;
      unit = std::max(unit.value_or(level), level);
    }
  }
  if (!unit)
    for (const LongDigits& x : seen)
      if (!x.is_zero()) unit = std::min(unit.value_or(x.exponent()), x.exponent());
  std::vector<Integer> scaled;
  Integer error = 0;
  for (const LongDigits& x : seen) {
    const std::int64_t up = x.exponent() - unit.value_or(0);
    if (up >= 0) {
      scaled.push_back(x.number() << static_cast<std::size_t>(up));
      error = std::max(error, Integer(Integer(x.error()) << static_cast<std::size_t>(up)));
    } else {
      scaled.push_back(x.number() >> static_cast<std::size_t>(-up));
      error = std::max(error, Integer((Integer(x.error()) >> static_cast<std::size_t>(-up)) + 2));
    }
  }
  return {scaled, error};
}

Variations exact_variations(const WidePolynomial& polynomial, const Dyadic& lower, const Dyadic& upper) {
  const auto enough = [](const Variations& v) { return v.least == v.most || v.least >= 2; };
  if (const Variations rough = polynomial.variations_on(lower, upper); enough(rough)) return rough;
  const detail::Ends ends(lower, upper);
  return to_enough_bits(
      256, bits_at(polynomial, ends.exponent) / 2, [&](std::size_t bits) -> std::optional<Variations> {
        const auto seen =
            detail::seen_on(cut(polynomial.whole(), bits), LongDigits(1, bits), LongDigits(ends.lower, bits),
                            LongDigits(ends.upper, bits), LongDigits(ends.above_lower, bits),
                            LongDigits(ends.above_upper, bits));
        const Variations v = detail::variations_of(seen, std::nullopt, std::nullopt);
        return enough(v) ? std::optional(v) : std::nullopt;
      });
}

Integer newton_cell(const WidePolynomial& polynomial, const Dyadic& from, const Dyadic& to, int multiplicity,
                    unsigned digits) {
  const detail::Ends ends(from, to);
  const auto degree = static_cast<long>(polynomial.size() - 1);
  // The first two coefficients on the way are value and value + slope / degree, times binomials: the step is
  // multiplicity * value / -slope.
  using Step = std::pair<LongDigits, LongDigits>;
  const Step step = to_enough_bits(
      std::max<std::size_t>(256, 2 * digits), bits_at(polynomial, ends.exponent) / 2,
      [&](std::size_t bits) -> std::optional<Step> {
        auto seen =
            detail::seen_on(cut(polynomial.whole(), bits), LongDigits(1, bits), LongDigits(ends.lower, bits),
                            LongDigits(ends.upper, bits), LongDigits(ends.above_lower, bits),
                            LongDigits(ends.above_upper, bits), 2);
        Step found{seen[0], seen[0]};
        found.first *= LongDigits(multiplicity, bits);
        found.second *= LongDigits(degree, bits);
        seen[1] *= LongDigits(-1, bits);
        found.second += seen[1];
        const bool enough = bits == LongDigits::unlimited ||
                            (found.first.has_digits(digits) && found.second.has_digits(digits));
        return enough ? std::optional(std::move(found)) : std::nullopt;
      });
  Integer length = step.first.number(), slope = step.second.number();
  if (slope == 0 || slope.sign() != length.sign()) return -1;
  const std::int64_t apart = step.first.exponent() - step.second.exponent();
  (apart > 0 ? length : slope) <<= static_cast<std::size_t>(std::abs(apart));
  const Integer cell = (length << digits) / slope;
  return cell < (Integer(1) << digits) ? cell : Integer(-1);
}

}  // namespace kds
