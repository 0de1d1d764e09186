#include "certificates/exact/precise_values.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <utility>
#include <vector>

#include "certificates/exact/bernstein_parts.h"

namespace kds {

namespace {

using Longs = std::vector<LongEnclosure>;

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
  return std::move(*answer(LongEnclosure::unlimited));
}

std::size_t bits_at(const ExactPolynomial& polynomial, unsigned exponent) {
  return polynomial.largest_bit_length() + exponent * (polynomial.leading_digits().size() - 1);
}

}  // namespace

LongEnclosure value_at(const ExactPolynomial& polynomial, const Dyadic& u, std::size_t digits) {
  const std::size_t degree = polynomial.leading_digits().size() - 1;
  const Integer later = u.numerator(), earlier = (Integer(1) << u.exponent()) - u.numerator();
  LongEnclosure value(detail::value_of(polynomial.leading_digits(), Enclosure::of(1), Enclosure::of(later),
                                       Enclosure::of(earlier)));
  if (!value.has_digits(digits)) {
    value = to_enough_bits(
        std::max<std::size_t>(256, 2 * digits), bits_at(polynomial, u.exponent()) / 2,
        [&](std::size_t bits) -> std::optional<LongEnclosure> {
          LongEnclosure at_u = detail::value_of(cut(polynomial.scaled(), bits), LongEnclosure(1, bits),
                                                LongEnclosure(later, bits), LongEnclosure(earlier, bits));
          return bits == LongEnclosure::unlimited || at_u.has_digits(digits) ? std::optional(std::move(at_u))
                                                                             : std::nullopt;
        });
  }
  value.scale(-static_cast<std::int64_t>(u.exponent()) * static_cast<std::int64_t>(degree));
  return value;
}

Variations exact_variations(const ExactPolynomial& polynomial, const Dyadic& lower, const Dyadic& upper) {
  const auto enough = [](const Variations& v) { return v.least == v.most || v.least >= 2; };
  if (const Variations rough = polynomial.variations_on(lower, upper); enough(rough)) return rough;
  const detail::Ends ends(lower, upper);
  return to_enough_bits(
      256, bits_at(polynomial, ends.exponent) / 2, [&](std::size_t bits) -> std::optional<Variations> {
        const auto seen =
            detail::seen_on(cut(polynomial.scaled(), bits), LongEnclosure(1, bits),
                            LongEnclosure(ends.lower, bits), LongEnclosure(ends.upper, bits),
                            LongEnclosure(ends.above_lower, bits), LongEnclosure(ends.above_upper, bits));
        const Variations v = detail::variations_of(seen, std::nullopt, std::nullopt);
        return enough(v) ? std::optional(v) : std::nullopt;
      });
}

Integer newton_cell(const ExactPolynomial& polynomial, const Dyadic& from, const Dyadic& to, int multiplicity,
                    unsigned digits) {
  const detail::Ends ends(from, to);
  const auto degree = static_cast<long>(polynomial.leading_digits().size() - 1);
  // The first two coefficients on the way are value and value + slope / degree, times binomials: the step is
  // multiplicity * value / -slope.
  using Step = std::pair<LongEnclosure, LongEnclosure>;
  const Step step = to_enough_bits(
      std::max<std::size_t>(256, 2 * digits), bits_at(polynomial, ends.exponent) / 2,
      [&](std::size_t bits) -> std::optional<Step> {
        auto seen =
            detail::seen_on(cut(polynomial.scaled(), bits), LongEnclosure(1, bits),
                            LongEnclosure(ends.lower, bits), LongEnclosure(ends.upper, bits),
                            LongEnclosure(ends.above_lower, bits), LongEnclosure(ends.above_upper, bits), 2);
        Step found{seen[0], seen[0]};
        found.first *= LongEnclosure(multiplicity, bits);
        found.second *= LongEnclosure(degree, bits);
        seen[1] *= LongEnclosure(-1, bits);
        found.second += seen[1];
        const bool enough = bits == LongEnclosure::unlimited ||
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
