#include "kds/event.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>

#include "certificates/exact/exact_time.h"
#include "certificates/exact/time_span.h"

namespace kds {

namespace {

constexpr int most_digits = 12;

Integer power_of_ten(int exponent) {
  Integer power;
  mpz_ui_pow_ui(power.get_mpz_t(), 10, static_cast<unsigned long>(exponent));
  return power;
}

Rational in_units(const Rational& value, int exponent) {
  const Rational power(power_of_ten(std::abs(exponent)));
  return exponent > 0 ? Rational(value / power) : Rational(value * power);
}

/// The number digits * 10^exponent. The last digit of the number is 0 only if the number is 0.
struct Decimal {
  std::int64_t digits = 0;
  int exponent = 0;

  [[nodiscard]] Rational value() const {
    return in_units(Rational(Integer(static_cast<long>(digits))), -exponent);
  }
  [[nodiscard]] double nearest() const {
    const std::string text = fmt::format("{}e{}", digits, exponent);
    double number = 0;
    std::from_chars(text.data(), text.data() + text.size(), number);
    return number;
  }
  friend bool operator==(const Decimal& a, const Decimal& b) = default;
};

/// Returns the largest e with 10^e <= |value|.
int magnitude(const Rational& value) {
  const Rational size = abs(value);
  const auto bits = [](const Integer& x) { return static_cast<double>(bit_length(x)); };
  constexpr double decimals_per_bit = 0.30102999566398120;
  int e = static_cast<int>((bits(numerator(size)) - bits(denominator(size))) * decimals_per_bit) + 1;
  while (in_units(size, e) < Rational(1)) --e;
  return e;
}

/// Returns the nearest multiple of 10^exponent, half to even.
Decimal rounded_to(const Rational& value, int exponent) {
  const Rational scaled = in_units(value, exponent);
  Integer whole;
  const Integer twice_numerator = numerator(scaled) * Integer(2) + denominator(scaled);
  const Integer twice_denominator = denominator(scaled) * Integer(2);
  mpz_fdiv_q(whole.get_mpz_t(), twice_numerator.get_mpz_t(), twice_denominator.get_mpz_t());  // half up
  const bool tie = mpz_divisible_p(twice_numerator.get_mpz_t(), twice_denominator.get_mpz_t()) != 0;
  if (tie && mpz_odd_p(whole.get_mpz_t()) != 0) whole -= Integer(1);
  Decimal decimal{whole.get_si(), exponent};
  if (decimal.digits == 0) return {};
  for (; decimal.digits % 10 == 0; decimal.digits /= 10) ++decimal.exponent;
  return decimal;
}

Decimal rounded(const Rational& value) {
  return sgn(value) == 0 ? Decimal{} : rounded_to(value, magnitude(value) + 1 - most_digits);
}

/// Rounds both numbers to as many digits as possible while the results agree, and returns that result.
Decimal common_digits(const Rational& a, const Rational& b) {
  int exponent = magnitude(std::max(abs(a), abs(b))) + 1 - most_digits;
  while (!(rounded_to(a, exponent) == rounded_to(b, exponent))) ++exponent;
  return rounded_to(a, exponent);
}

/// A linear scale with value `begin` at u = 0 and `end` at u = 1.
class Scale {
 public:
  Scale(double begin, double end) : begin_(begin), length_(Rational(end) - begin_) {}

  [[nodiscard]] Rational at(const Dyadic& u) const { return begin_ + u.rational() * length_; }
  [[nodiscard]] bool is_point() const { return sgn(length_) == 0; }

  [[nodiscard]] Decimal rounded(ExactTime& time) const {
    Rational at_lower = at(time.lower()), at_upper = at(time.upper());
    while (!time.is_dyadic() && is_wide(at_lower, at_upper)) {
      if (sgn(at_lower) * sgn(at_upper) < 0) {
        if (compare_with(time, in_interval(Rational(0))) == 0) return {};
      } else {
        narrow(time, std::max(abs(at_lower), abs(at_upper)));
      }
      at_lower = at(time.lower());
      at_upper = at(time.upper());
    }
    const Decimal first = kds::rounded(at_lower), last = kds::rounded(at_upper);
    if (first == last) return first;
    // The bracket is so narrow that these two numbers are neighbours. The number half way between them
    // decides which one is nearer.
    const Rational tie = (first.value() + last.value()) / Rational(2);
    const int side = compare_with(time, in_interval(tie));
    return side < 0 ? first : side > 0 ? last : kds::rounded(tie);
  }

 private:
  /// Returns whether the bracket is longer than 10^-13 of its smaller end. (This width is at most a tenth of
  /// the last digit.)
  static bool is_wide(const Rational& a, const Rational& b) {
    return abs(a - b) * Rational(power_of_ten(most_digits + 1)) > std::min(abs(a), abs(b));
  }
  void narrow(ExactTime& time, const Rational& size) const {
    const double width = 0.5e-13 * Rational(size / abs(length_)).get_d();
    constexpr double least = 0x1p-900;  // smaller widths may underflow
    if (width < least)
      time.refine();
    else
      time.narrow_to_width(width);
  }
  [[nodiscard]] Rational in_interval(const Rational& value) const { return (value - begin_) / length_; }

  Rational begin_, length_;
};

/// If all numbers from `least` to `most` round to one number of most_digits digits, and doubles tell it,
/// returns this number. Rounding is monotone, so both ends decide.
std::optional<double> nearest_to_all(double least, double most) {
  if (!(least > 1e-250 && most < 1e250)) return std::nullopt;  // no overflow, and no underflow
  const auto text_of = [](double value) { return fmt::format("{:.{}e}", value, most_digits - 1); };
  const std::string text = text_of(least);
  if (text != text_of(most)) return std::nullopt;
  double number = 0;
  std::from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

/// Rounds one time on several scales. Constructs the exact root only if the bracket does not suffice.
class TimeOnScales {
 public:
  explicit TimeOnScales(const Instant& now) : now_(now), lower_(now.lower()), upper_(now.upper()) {}

  double on(double begin, double end) {
    // The difference, the product and the sum have errors below 2^-52 of the largest number each.
    const double spare = 0x1p-50 * (std::abs(begin) + std::abs(end)), length = end - begin;
    const double at_lower = begin + now_.lower() * length, at_upper = begin + now_.upper() * length;
    if (const auto nearest =
            nearest_to_all(std::min(at_lower, at_upper) - spare, std::max(at_lower, at_upper) + spare))
      return *nearest;
    const Scale scale(begin, end);
    if (scale.is_point()) return rounded(scale.at(lower_)).nearest();
    const Rational first = scale.at(lower_), last = scale.at(upper_);
    if (const Decimal decimal = rounded(first); decimal == rounded(last)) return decimal.nearest();
    if (!exact_) exact_ = now_.exact_apart();
    return (exact_ ? scale.rounded(*exact_) : common_digits(first, last)).nearest();
  }

 private:
  const Instant& now_;
  Dyadic lower_, upper_;
  std::optional<ExactTime> exact_;
};

}  // namespace

RoundedTime rounded_time(const Instant& now, const FrameStamp& from, const FrameStamp& to) {
  TimeOnScales scales(now);
  RoundedTime time{scales.on(static_cast<double>(from.number), static_cast<double>(to.number)), {}};
  if (from.picoseconds && to.picoseconds) time.picoseconds = scales.on(*from.picoseconds, *to.picoseconds);
  return time;
}

TimeBracket canonical_bracket(const Instant& now, unsigned bits) {
  const auto cells = static_cast<double>(std::uint64_t{1} << bits);
  const double first = std::floor(now.lower() * cells), last = std::ceil(now.upper() * cells);
  if (last <= first + 1) return {first / cells, last / cells};
  std::optional<ExactTime> time = now.exact_apart();
  if (!time) return {now.lower(), now.upper()};
  const double after = next_on_grid(*time, bits).round_down(), before = after - 1 / cells;
  return {before, time->is_dyadic() && time->lower() == Dyadic(before) ? before : after};
}

}  // namespace kds
