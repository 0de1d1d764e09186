#include "motions/numbers/leading_digits.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace kds {

namespace {

constexpr int error_bits = 62;

int width_of(Wide x) {
  const auto high = static_cast<std::uint64_t>(x >> 64U);
  return high != 0 ? 64 + std::bit_width(high) : std::bit_width(static_cast<std::uint64_t>(x));
}

/// An unsigned 256-bit integer: high 2^128 + low.
struct Widest {
  Wide high = 0, low = 0;

  [[nodiscard]] int width() const { return high != 0 ? 128 + width_of(high) : width_of(low); }
  void add(Wide more_high, Wide more_low) {
    low += more_low;
    high += more_high + (low < more_low ? 1 : 0);
  }
  /// Returns floor(value / 2^shift), which must fit into 128 bits.
  [[nodiscard]] Wide shifted(int shift) const {
    if (shift == 0) return low;
    if (shift >= 256) return 0;
    if (shift >= 128) return high >> static_cast<unsigned>(shift - 128);
    return (high << static_cast<unsigned>(128 - shift)) | (low >> static_cast<unsigned>(shift));
  }
};

Widest product(Wide a, Wide b) {
  const auto low = [](Wide x) { return Wide{static_cast<std::uint64_t>(x)}; };
  const Wide a0 = low(a), a1 = a >> 64U, b0 = low(b), b1 = b >> 64U;
  Widest sum{a1 * b1, a0 * b0};
  for (const Wide cross : {a0 * b1, a1 * b0}) sum.add(cross >> 64U, cross << 64U);
  return sum;
}

Widest product(Wide a, std::uint64_t b) {
  Widest sum{0, Wide{static_cast<std::uint64_t>(a)} * b};
  const Wide upper = (a >> 64U) * b;
  sum.add(upper >> 64U, upper << 64U);
  return sum;
}

}  // namespace

LeadingDigits LeadingDigits::of(long long x) {
  LeadingDigits result;
  result.negative = x < 0;
  result.magnitude = x < 0 ? -static_cast<std::uint64_t>(x) : static_cast<std::uint64_t>(x);
  return result;
}

LeadingDigits LeadingDigits::of(const Integer& x) {
  mpz_srcptr whole = x.get_mpz_t();
  LeadingDigits result;
  result.negative = mpz_sgn(whole) < 0;
  const std::size_t limbs = mpz_size(whole);
  const auto limb = [&](std::size_t i) { return Wide{mpz_getlimbn(whole, static_cast<mp_size_t>(i))}; };
  if (limbs == 0) return result;
  const auto bits = static_cast<std::int64_t>(mpz_sizeinbase(whole, 2));
  const std::int64_t shift = std::max<std::int64_t>(0, bits - most_bits);
  // The leading bits lie in at most three limbs.
  const auto first = static_cast<std::size_t>(shift / 64);
  Widest top;
  for (std::size_t i = std::min(limbs, first + 3); i-- > first;) {
    top.high = (top.high << 64U) | (top.low >> 64U);
    top.low = (top.low << 64U) | limb(i);
  }
  result.magnitude = top.shifted(static_cast<int>(shift % 64));
  result.exponent = shift;
  result.error = shift > 0 && static_cast<std::int64_t>(mpz_scan1(whole, 0)) < shift ? 1 : 0;
  return result;
}

std::int64_t LeadingDigits::top_bit() const { return exponent + width_of(magnitude + error); }

LeadingDigits operator*(const LeadingDigits& a, const LeadingDigits& b) {
  LeadingDigits result;
  if (a.is_zero() || b.is_zero()) return result;
  const Widest whole = product(a.magnitude, b.magnitude);
  Widest error;
  if ((a.error | b.error) != 0) {
    // |ab - a'b'| <= |a'| db + (|b'| + db) da
    error = product(a.magnitude, b.error);
    const Widest other = product(b.magnitude + b.error, a.error);
    error.add(other.high, other.low);
  }
  const int shift = std::max({0, whole.width() - LeadingDigits::most_bits, error.width() - (error_bits - 1)});
  result.magnitude = whole.shifted(shift);
  result.error = static_cast<std::uint64_t>(error.shifted(shift)) + (shift > 0 ? 2 : 0);
  result.exponent = a.exponent + b.exponent + shift;
  result.negative = a.negative != b.negative;
  return result;
}

LeadingDigits& LeadingDigits::operator+=(const LeadingDigits& other) {
  if (other.is_zero()) return *this;
  if (is_zero()) return *this = other;
  LeadingDigits low = other;
  if (exponent < low.exponent) std::swap(*this, low);
  // Lower the larger exponent as far as the number has room. The other number's bits below its last bit are
  // dropped and counted in the error.
  const std::int64_t apart = exponent - low.exponent;
  const int room =
      std::min(most_bits - width_of(magnitude), error_bits - 1 - static_cast<int>(std::bit_width(error)));
  const auto up = static_cast<unsigned>(std::clamp<std::int64_t>(apart, 0, std::max(0, room)));
  magnitude <<= up;
  error <<= up;
  exponent -= up;
  if (const std::int64_t down = apart - up; down > 0) {
    const bool far = down >= 128;
    const Wide kept = far ? 0 : low.magnitude >> static_cast<unsigned>(down);
    low.error = down >= 64 ? 2 : (low.error >> static_cast<unsigned>(down)) + 2;
    low.magnitude = kept;
  }
  if (negative == low.negative) {
    magnitude += low.magnitude;
  } else if (magnitude >= low.magnitude) {
    magnitude -= low.magnitude;
  } else {
    magnitude = low.magnitude - magnitude;
    negative = low.negative;
  }
  error += low.error;
  if (width_of(magnitude) > most_bits || std::bit_width(error) > error_bits) {
    magnitude >>= 1U;
    error = (error >> 1U) + 2;
    ++exponent;
  }
  return *this;
}

}  // namespace kds
