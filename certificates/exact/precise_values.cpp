#include "certificates/exact/precise_values.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "certificates/exact/halves.h"

namespace kds {

namespace {

using Longs = std::vector<LongDigits>;

Longs cut(const std::vector<Integer>& c, std::size_t bits) {
  Longs result;
  result.reserve(c.size());
  for (const Integer& x : c) result.emplace_back(x, bits);
  return result;
}

/// A number type with a fixed number of words, or with any number of bits.
template <int Words>
struct InWords {
  using Number = FixedDigits<Words>;
  static constexpr bool exact = false;

  [[nodiscard]] static const std::vector<Number>& coefficients(const WidePolynomial& p) {
    return p.in_words<Words>();
  }
  [[nodiscard]] static Number of(const Integer& x) { return Number(x); }
  [[nodiscard]] static Number between(const Integer& low, const Integer& high) {
    return Number::between(low, high);
  }
  [[nodiscard]] static LongDigits long_digits(const Number& x) { return x.long_digits(); }
};
struct InBits {
  using Number = LongDigits;
  std::size_t bits;
  bool exact = bits == LongDigits::unlimited;

  [[nodiscard]] Longs coefficients(const WidePolynomial& p) const { return cut(p.whole(), bits); }
  [[nodiscard]] Number of(const Integer& x) const { return {x, bits}; }
  [[nodiscard]] Number between(const Integer& low, const Integer& high) const {
    return Number::between(low, high, bits);
  }
  [[nodiscard]] static LongDigits long_digits(Number x) { return x; }
};

/// The number type of the leading digits.
struct InLeadingDigits {
  using Number = LeadingDigits;

  [[nodiscard]] static const std::vector<Number>& coefficients(const WidePolynomial& p) {
    return p.leading_digits();
  }
  [[nodiscard]] static Number of(const Integer& x) { return Number::of(x); }
  [[nodiscard]] static LongDigits long_digits(const Number& x) { return LongDigits(x); }
};

/// Calls `answer` with a number type of at least about `bits` bits.
template <class Answer>
auto with_bits(std::size_t bits, Answer answer) {
  if (bits <= 256) return answer(InWords<4>{});
  if (bits <= 512) return answer(InWords<8>{});
  if (bits <= 1024) return answer(InWords<16>{});
  if (bits <= 2048) return answer(InWords<32>{});
  return answer(InBits{bits});
}

/// Calls `answer` with more and more bits until it returns a result, finally without a limit.
template <class Answer>
auto to_enough_bits(std::size_t bits, std::size_t all, Answer answer) {
  for (; bits < all; bits *= 2) {
    if (auto found = with_bits(bits, answer)) return std::move(*found);
  }
  return std::move(*answer(InBits{LongDigits::unlimited}));
}

/// Returns the polynomial restricted to an interval, in the given number type.
template <class Numbers>
auto seen_in(const Numbers& numbers, const WidePolynomial& polynomial, const detail::Ends& ends) {
  return detail::seen_on(numbers.coefficients(polynomial), numbers.of(1), numbers.of(ends.lower),
                         numbers.of(ends.upper), numbers.of(ends.above_lower), numbers.of(ends.above_upper));
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
        [&](const auto& numbers) -> std::optional<LongDigits> {
          LongDigits at_u = numbers.long_digits(detail::value_of(
              numbers.coefficients(polynomial), numbers.of(1), numbers.of(later), numbers.of(earlier)));
          return numbers.exact || at_u.has_digits(digits) ? std::optional(std::move(at_u)) : std::nullopt;
        });
  }
  value.scale(-static_cast<std::int64_t>(u.exponent()) * static_cast<std::int64_t>(degree));
  return value;
}

namespace {

/// Returns how many binary digits both ends have in common, measured from 0 or 1, whichever is nearer.
std::size_t digits_of(const detail::Ends& ends) {
  const std::size_t places = std::min(bit_length(ends.upper), bit_length(ends.above_lower));
  return places - std::min(places, bit_length(ends.upper - ends.lower));
}

}  // namespace

int sign_closely(const WidePolynomial& polynomial, const Dyadic& lower, const Dyadic& upper) {
  const detail::Ends ends(lower, upper);
  // Bits far below the interval's own uncertainty cannot help to decide the sign.
  constexpr std::size_t spare_bits = 128;
  return with_bits(digits_of(ends) + spare_bits, [&](const auto& numbers) {
    return detail::value_of(numbers.coefficients(polynomial), numbers.of(1),
                            numbers.between(ends.lower, ends.upper),
                            numbers.between(ends.above_upper, ends.above_lower))
        .certain_sign();
  });
}

Halves seen_closely(const WidePolynomial& polynomial, const Dyadic& lower, const Dyadic& upper,
                    std::size_t bits) {
  const detail::Ends ends(lower, upper);
  if (bits >= bits_at(polynomial, ends.exponent) / 2) bits = LongDigits::unlimited;
  const auto look = [&](const auto& numbers) {
    Longs longs;
    for (const auto& x : seen_in(numbers, polynomial, ends)) longs.push_back(numbers.long_digits(x));
    return longs;
  };
  const Longs seen = bits <= LeadingDigits::most_bits ? look(InLeadingDigits{}) : with_bits(bits, look);
  // Choose a unit slightly smaller than the largest error.
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

namespace {

bool is_enough(const Variations& v) { return v.least == v.most || v.least >= 2; }

}  // namespace

Variations variations_closely(const WidePolynomial& polynomial, const Dyadic& lower, const Dyadic& upper,
                              std::size_t& bits) {
  const detail::Ends ends(lower, upper);
  const std::size_t first = bits;
  std::size_t tried = 0;
  return to_enough_bits(
      first, bits_at(polynomial, ends.exponent) / 2, [&](const auto& numbers) -> std::optional<Variations> {
        bits = first << tried++;
        const Variations v =
            detail::variations_of(seen_in(numbers, polynomial, ends), std::nullopt, std::nullopt);
        return is_enough(v) ? std::optional(v) : std::nullopt;
      });
}

Variations exact_variations(const WidePolynomial& polynomial, const Dyadic& lower, const Dyadic& upper) {
  if (const Variations rough = polynomial.variations_on(lower, upper); is_enough(rough)) return rough;
  // Numbers with fewer digits cannot distinguish the ends.
  std::size_t bits = std::bit_ceil(std::max<std::size_t>(256, digits_of(detail::Ends(lower, upper))));
  return variations_closely(polynomial, lower, upper, bits);
}

}  // namespace kds
