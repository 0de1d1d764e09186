#include "certificates/exact/wide_polynomial.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "certificates/exact/halves.h"
#include "certificates/exact/polynomial_gcd.h"
#include "certificates/exact/precise_values.h"

namespace kds {

namespace {

/// Returns whether the number is exact or at least `digits` leading bits are correct.
bool has_digits(const LeadingDigits& x, std::size_t digits) { return x.magnitude >> digits >= x.error; }
bool has_digits(const LongDigits& x, std::size_t digits) { return x.has_digits(digits); }

std::int64_t top_bit(const LeadingDigits& x) { return x.top_bit(); }
std::int64_t top_bit(const LongDigits& x) {
  return x.exponent() +
         static_cast<std::int64_t>(std::max<std::size_t>(
             bit_length(x.number()), static_cast<std::size_t>(std::bit_width(x.error())))) +
         1;
}

/// Returns whether `digits` correct leading bits suffice. Each coefficient must either have as many correct
/// bits itself, or be negligible everywhere in (0,1). It is negligible if it lies `digits` bits below the
/// Newton polygon: one coefficient before it and one after it have enough correct bits and outweigh it.
template <class Number>
bool suffice(const std::vector<Number>& c, std::size_t digits) {
  struct Corner {
    std::int64_t place, top;
    /// Returns whether this corner is on or below the line through the two others.
    [[nodiscard]] bool is_below(const Corner& from, const Corner& to) const {
      return (top - from.top) * (to.place - from.place) <= (to.top - from.top) * (place - from.place);
    }
  };
  std::vector<Corner> polygon, doubtful;
  for (std::size_t k = 0; k < c.size(); ++k) {
    const Corner corner{static_cast<std::int64_t>(k), top_bit(c[k])};
    if (!has_digits(c[k], digits)) {
      doubtful.push_back({corner.place, corner.top + static_cast<std::int64_t>(digits)});
    } else if (!c[k].is_zero()) {
      while (polygon.size() > 1 && polygon.back().is_below(polygon[polygon.size() - 2], corner))
        polygon.pop_back();
      polygon.push_back(corner);
    }
  }
  return std::all_of(doubtful.begin(), doubtful.end(), [&](const Corner& x) {
    const auto after =
        std::find_if(polygon.begin(), polygon.end(), [&](const Corner& y) { return y.place > x.place; });
    return after != polygon.begin() && after != polygon.end() && x.is_below(*(after - 1), *after);
  });
}

/// Returns a ball that contains every number between two bounds, 0 <= low <= high.
LeadingDigits between(const Integer& low, const Integer& high) {
  LeadingDigits all = LeadingDigits::of(high);
  const Integer length = high - low;
  const auto bits = static_cast<std::int64_t>(bit_length(length));
  if (const std::int64_t down = bits - 60 - all.exponent; down > 0) {
    all.magnitude = down >= 128 ? 0 : all.magnitude >> static_cast<unsigned>(down);
    all.exponent += down;
    all.error = 1;
  }
  const Integer units = length >> static_cast<std::size_t>(all.exponent);
  all.error += mpz_get_ui(units.get_mpz_t()) + 1;
  return all;
}

template <class Number>
std::vector<Number> negatives_of(const std::vector<Number>& numbers) {
  std::vector<Number> negatives;
  negatives.reserve(numbers.size());
  for (const Number& x : numbers) negatives.push_back(-x);
  return negatives;
}

}  // namespace

const std::vector<Integer>& WidePolynomial::whole() const {
  if (!whole_) whole_ = opposite_ ? negatives_of(opposite_->whole()) : source_->whole();
  return *whole_;
}

const std::vector<LeadingDigits>& WidePolynomial::leading_digits() const {
  if (leading_) return *leading_;
  if (opposite_) return leading_.emplace(negatives_of(opposite_->leading_digits()));
  // Store the digits only when complete: forming them may throw.
  std::vector<LeadingDigits> digits;
  if (!whole_) digits = source_->leading_digits();
  constexpr std::size_t enough = LeadingDigits::most_bits / 2;
  if (whole_ || !suffice(digits, enough)) {
    // Nearly all digits of the terms may cancel, so form the coefficients more precisely.
    digits.clear();
    if (const std::vector<LongDigits>* formed = formed_to(enough)) {
      for (const LongDigits& x : *formed) digits.push_back(x.leading_digits());
    } else {
      for (const Integer& x : whole()) digits.push_back(LeadingDigits::of(x));
    }
  }
  leading_ = std::move(digits);
  return *leading_;
}

const std::vector<LongDigits>* WidePolynomial::formed_to(std::size_t bits) const {
  if (whole_) return nullptr;
  if (formed_words_ != 0 && suffice(formed_, bits)) return &formed_;
  for (const std::size_t words : CoefficientSource::word_counts) {
    if (words <= formed_words_) continue;
    formed_ = source_->digits(words);
    formed_words_ = words;
    if (suffice(formed_, bits)) return &formed_;
  }
  return nullptr;
}

template <int Words>
const std::vector<FixedDigits<Words>>& WidePolynomial::in_words() const {
  auto& known = std::get<InWords<Words>>(in_words_);
  if (known) return *known;
  if (opposite_) return known.emplace(negatives_of(opposite_->in_words<Words>()));
  std::vector<FixedDigits<Words>> digits;
  if (const std::vector<LongDigits>* formed = formed_to(32 * Words)) {
    for (const LongDigits& x : *formed) digits.emplace_back(x);
  } else {
    for (const Integer& x : whole()) digits.emplace_back(x);
  }
  return known.emplace(std::move(digits));
}
template const std::vector<FixedDigits<4>>& WidePolynomial::in_words() const;
template const std::vector<FixedDigits<8>>& WidePolynomial::in_words() const;
template const std::vector<FixedDigits<16>>& WidePolynomial::in_words() const;
template const std::vector<FixedDigits<32>>& WidePolynomial::in_words() const;

const std::vector<Residue>& WidePolynomial::residues() const {
  if (!residues_)
    residues_ = opposite_ ? negatives_of(opposite_->residues())
                : whole_  ? image_of(*whole_)
                          : source_->residues(residue_folds[0]);
  return *residues_;
}

std::size_t WidePolynomial::largest_bit_length() const {
  std::int64_t bits = 0;
  for (const LeadingDigits& x : leading_digits()) {
    if (!x.is_zero()) bits = std::max(bits, x.top_bit());
  }
  return static_cast<std::size_t>(bits);
}

bool WidePolynomial::is_zero() const {
  bool zero = true;
  for (const LeadingDigits& x : leading_digits()) {
    if (x.certain_sign() != 0) return false;
    zero &= x.is_zero();
  }
  return zero || std::all_of(whole().begin(), whole().end(), [](const Integer& x) { return x == 0; });
}

int WidePolynomial::first_sign() const {
  for (const LeadingDigits& x : leading_digits()) {
    if (const int sign = x.certain_sign()) return sign;
    if (!x.is_zero()) break;
  }
  for (const Integer& x : whole()) {
    if (x != 0) return sgn(x);
  }
  return 0;
}

int WidePolynomial::sign_at(const Dyadic& u) const {
  const std::vector<LeadingDigits>& leading = leading_digits();
  if (leading.empty()) return 0;
  if (u.exponent() == 0 && u.numerator() == 0) {
    const LeadingDigits& first = leading.front();
    return first.certain_sign() != 0 || first.is_zero() ? first.certain_sign() : sgn(whole().front());
  }
  const LeadingDigits rough =
      detail::value_of(leading, LeadingDigits::of(1), LeadingDigits::of(u.numerator()),
                       LeadingDigits::of((Integer(1) << u.exponent()) - u.numerator()));
  if (const int sign = rough.certain_sign(); sign != 0 || rough.is_zero()) return sign;
  return value_at(*this, u, 1).certain_sign();
}

int WidePolynomial::sign_on(const Dyadic& lower, const Dyadic& upper) const {
  if (leading_digits().empty()) return 0;
  const detail::Ends ends(lower, upper);
  return detail::value_of(leading_digits(), LeadingDigits::of(1), between(ends.lower, ends.upper),
                          between(ends.above_upper, ends.above_lower))
      .certain_sign();
}

int WidePolynomial::sign_variations() const {
  const Variations rough = detail::variations_of(leading_digits(), std::nullopt, std::nullopt);
  return rough.least == rough.most ? rough.least : detail::sign_variations_of(whole());
}

Variations WidePolynomial::variations_on(const Dyadic& lower, const Dyadic& upper,
                                         std::optional<int> sign_at_lower,
                                         std::optional<int> sign_at_upper) const {
  const std::vector<LeadingDigits>& c = leading_digits();
  if (c.empty() || (lower.numerator() == 0 && upper == Dyadic(1.0)))
    return detail::variations_of(c, sign_at_lower, sign_at_upper);
  const detail::Ends ends(lower, upper);
  return detail::variations_of(
      detail::seen_on(c, LeadingDigits::of(1), LeadingDigits::of(ends.lower), LeadingDigits::of(ends.upper),
                      LeadingDigits::of(ends.above_lower), LeadingDigits::of(ends.above_upper)),
      sign_at_lower, sign_at_upper);
}

}  // namespace kds
