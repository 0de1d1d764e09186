#include "motions/numbers/long_digits.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace kds {

namespace {

constexpr std::size_t most_error_bits = 61;

std::size_t bit_width_of(const Integer& x) {
  mpz_srcptr whole = x.get_mpz_t();
  const std::size_t limbs = mpz_size(whole);
  return limbs == 0
             ? 0
             : 64 * (limbs - 1) +
                   static_cast<std::size_t>(std::bit_width(std::uint64_t{mpz_limbs_read(whole)[limbs - 1]}));
}

/// Returns floor(|x| / 2^bits), which must be less than 2^64.
std::uint64_t top_of(const Integer& x, std::size_t bits) {
  mpz_srcptr whole = x.get_mpz_t();
  const auto limb = [&](std::size_t i) {
    return std::uint64_t{mpz_getlimbn(whole, static_cast<mp_size_t>(i))};
  };
  const std::size_t first = bits / 64, rest = bits % 64;
  return rest == 0 ? limb(first) : (limb(first) >> rest) | (limb(first + 1) << (64 - rest));
}

std::size_t bit_width_of(Wide x) {
  const auto high = static_cast<std::uint64_t>(x >> 64U);
  return static_cast<std::size_t>(high != 0 ? 64 + std::bit_width(high)
                                            : std::bit_width(static_cast<std::uint64_t>(x)));
}

/// Returns x / 2^bits, rounded up.
std::uint64_t shifted_down(std::uint64_t x, std::size_t bits) {
  return bits >= 64 ? (x == 0 ? 0 : 1) : (x >> bits) + ((x & ((std::uint64_t{1} << bits) - 1)) != 0 ? 1 : 0);
}

/// A short upper bound of a size: mantissa 2^shift.
struct Bound {
  Wide mantissa;
  std::size_t shift;

  explicit Bound(const Integer& x) : mantissa(0), shift(0) {
    const std::size_t width = bit_width_of(x);
    if (width == 0) return;
    shift = width > 60 ? width - 60 : 0;
    mantissa = Wide{top_of(x, shift)} + (shift > 0 ? 1 : 0);
  }
  [[nodiscard]] std::size_t width() const { return mantissa == 0 ? 0 : bit_width_of(mantissa) + shift; }
  /// Returns an upper bound of (this bound) / 2^bits, which must fit into 64 bits.
  [[nodiscard]] std::uint64_t over(std::size_t bits) const {
    if (mantissa == 0) return 0;
    if (bits <= shift) return static_cast<std::uint64_t>(mantissa << (shift - bits));
    return bits - shift >= 128 ? 1 : static_cast<std::uint64_t>(mantissa >> (bits - shift)) + 1;
  }
};

}  // namespace

// Truncates while dividing, so that dropped digits are never copied.
LongDigits::LongDigits(const Integer& value, std::size_t most_bits) : most_bits_(most_bits) {
  const std::size_t width = bit_width_of(value);
  if (width <= most_bits) {
    value_ = value;
    return;
  }
  const std::size_t below = width - most_bits;
  mpz_tdiv_q_2exp(value_.get_mpz_t(), value.get_mpz_t(), below);
  error_ = mpz_scan1(value.get_mpz_t(), 0) >= below ? 0 : 1;
  exponent_ = static_cast<std::int64_t>(below);
}

LongDigits::LongDigits(Integer value, std::uint64_t error, std::int64_t exponent, std::size_t most_bits)
    : value_(std::move(value)), error_(error), exponent_(exponent), most_bits_(most_bits) {
  cut();
}

LongDigits::LongDigits(const LeadingDigits& number)
    : value_(static_cast<std::uint64_t>(number.magnitude >> 64U)),
      error_(number.error),
      exponent_(number.exponent),
      most_bits_(LeadingDigits::most_bits) {
  value_ = (value_ << 64U) + static_cast<std::uint64_t>(number.magnitude);
  if (number.negative) value_ = -value_;
  cut();
}

LongDigits LongDigits::between(const Integer& low, const Integer& high, std::size_t most_bits) {
  constexpr std::size_t length_bits = most_error_bits - 1;
  LongDigits all(high, most_bits);
  const Integer length = high - low;
  const std::size_t width = bit_width_of(length), below = static_cast<std::size_t>(all.exponent_);
  if (width > below + length_bits) all.shift_down(width - below - length_bits);
  const Integer units = length >> static_cast<std::size_t>(all.exponent_);
  all.error_ += mpz_get_ui(units.get_mpz_t()) + 1;
  return all;
}

LeadingDigits LongDigits::leading_digits() const {
  LeadingDigits leading = LeadingDigits::of(value_);
  leading.error += shifted_down(error_, static_cast<std::size_t>(leading.exponent));
  leading.exponent += exponent_;
  return leading;
}

int LongDigits::certain_sign() const {
  return mpz_cmpabs_ui(value_.get_mpz_t(), error_) <= 0 ? 0 : sgn(value_);
}

bool LongDigits::has_digits(std::size_t digits) const {
  return error_ == 0 || bit_width_of(value_) > digits + static_cast<std::size_t>(std::bit_width(error_));
}

std::size_t LongDigits::room(std::size_t wanted) const {
  const std::size_t width = bit_width_of(value_);
  std::size_t bits = most_bits_ - std::min(width, most_bits_);
  const auto of_error = static_cast<std::size_t>(std::bit_width(error_));
  if (error_ != 0) bits = std::min(bits, most_error_bits - std::min(of_error, most_error_bits));
  return std::min(bits, wanted);
}

void LongDigits::shift_down(std::size_t bits) {
  const bool exact = value_ == 0 || mpz_scan1(value_.get_mpz_t(), 0) >= bits;
  mpz_tdiv_q_2exp(value_.get_mpz_t(), value_.get_mpz_t(), bits);
  error_ = shifted_down(error_, bits) + (exact ? 0 : 1);
  exponent_ += static_cast<std::int64_t>(bits);
}

LongDigits& LongDigits::operator+=(const LongDigits& other) {
  most_bits_ = std::min(most_bits_, other.most_bits_);
  if (other.is_zero()) return *this;
  if (is_zero()) {
    value_ = other.value_;
    error_ = other.error_;
    exponent_ = other.exponent_;
    return *this;
  }
  // Lower the larger exponent as far as the number has room. Bits of the other number that are still below
  // are dropped.
  if (exponent_ >= other.exponent_) {
    const auto apart = static_cast<std::size_t>(exponent_ - other.exponent_);
    const std::size_t up = room(apart);
    value_ <<= up;
    if (error_ != 0) error_ <<= up;
    exponent_ -= static_cast<std::int64_t>(up);
    if (up < apart) {
      LongDigits low = other;
      low.shift_down(apart - up);
      value_ += low.value_;
      error_ += low.error_;
    } else {
      value_ += other.value_;
      error_ += other.error_;
    }
  } else {
    const auto apart = static_cast<std::size_t>(other.exponent_ - exponent_);
    const std::size_t up = other.room(apart);
    if (up < apart) shift_down(apart - up);
    value_ += other.value_ << up;
    if (other.error_ != 0) error_ += other.error_ << up;
  }
  cut();
  return *this;
}

LongDigits& LongDigits::operator*=(const LongDigits& other) {
  std::size_t down = 0;
  if (error_ != 0 || other.error_ != 0) {
    // |ab - a'b'| <= |a'| db + (|b'| + db) da
    Bound of_other(value_), of_own(other.value_);
    of_other.mantissa *= other.error_;
    of_own.mantissa += (of_own.shift >= 64 ? 0 : other.error_ >> of_own.shift) + 1;
    of_own.mantissa *= error_;
    const std::size_t width = std::max(of_other.width(), of_own.width()) + 1;
    down = width > most_error_bits ? width - most_error_bits : 0;
    error_ = of_other.over(down) + of_own.over(down);
  }
  value_ *= other.value_;
  exponent_ += other.exponent_;
  most_bits_ = std::min(most_bits_, other.most_bits_);
  if (down > 0) {
    const std::uint64_t error = error_;
    error_ = 0;
    shift_down(down);
    error_ += error;
  }
  cut();
  return *this;
}

void LongDigits::cut() {
  const std::size_t width = bit_width_of(value_), of_error = static_cast<std::size_t>(std::bit_width(error_));
  const std::size_t bits = std::max(width > most_bits_ ? width - most_bits_ : 0,
                                    of_error > most_error_bits ? of_error - most_error_bits : 0);
  if (bits > 0) shift_down(bits);
}

}  // namespace kds
