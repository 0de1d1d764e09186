#include "motions/numbers/fixed_digits.h"

#include <utility>

namespace kds {

namespace {

template <std::size_t N>
bool are_zero(const std::array<mp_limb_t, N>& limbs, std::size_t count) {
  return std::all_of(limbs.begin(), limbs.begin() + static_cast<std::ptrdiff_t>(count),
                     [](mp_limb_t x) { return x == 0; });
}

}  // namespace

template <int Most>
FixedDigits<Most> FixedDigits<Most>::of(long long x) {
  FixedDigits result;
  result.negative_ = x < 0;
  result.limbs_[0] = x < 0 ? -static_cast<std::uint64_t>(x) : static_cast<std::uint64_t>(x);
  result.size_ = x == 0 ? 0 : 1;
  return result;
}

template <int Most>
void FixedDigits<Most>::set(const Integer& number, std::uint64_t error, std::int64_t exponent) {
  const std::int64_t words = exponent >> 6, bits = exponent & 63;
  mpz_srcptr whole = number.get_mpz_t();
  const mp_limb_t* limbs = mpz_limbs_read(whole);
  const auto size = static_cast<std::int64_t>(mpz_size(whole));
  negative_ = mpz_sgn(whole) < 0;
  // Drop the lowest words that are zero, and the lowest words for which there is no room.
  std::int64_t first = std::max<std::int64_t>(0, size - Most);
  const bool exact = std::all_of(limbs, limbs + first, [](mp_limb_t x) { return x == 0; });
  if (error == 0 && exact)
    while (first < size && limbs[first] == 0) ++first;
  std::copy(limbs + first, limbs + size, limbs_.begin());
  size_ = static_cast<int>(size - first);
  exponent_ = words + first;
  error_ = static_cast<std::uint64_t>(over(error, first)) + (exact ? 0 : 1);
  if (error_ >> error_bits != 0) drop(1);
  *this <<= static_cast<unsigned>(bits);
}

template <int Most>
FixedDigits<Most> FixedDigits<Most>::between(const Integer& low, const Integer& high) {
  FixedDigits all(high);
  const Integer length = high - low;
  const auto bits = static_cast<std::int64_t>(bit_length(length));
  const std::int64_t words = bits > error_bits - 2 ? (bits - (error_bits - 2) + 63) / 64 : 0;
  // Drop words until the length has few enough bits to be an error bound.
  if (all.size_ == 0) all.exponent_ = words;
  all.drop(words - all.exponent_);
  const Integer units = length >> static_cast<std::size_t>(64 * all.exponent_);
  all.error_ += mpz_get_ui(units.get_mpz_t()) + 1;
  return all;
}

template <int Most>
LongDigits FixedDigits<Most>::long_digits() const {
  Integer number;
  if (size_ > 0) {
    mp_limb_t* limbs = mpz_limbs_write(number.get_mpz_t(), size_);
    std::copy_n(limbs_.begin(), size_, limbs);
    mpz_limbs_finish(number.get_mpz_t(), negative_ ? -size_ : size_);
  }
  return {number, error_, 64 * exponent_, static_cast<std::size_t>(64 * Most)};
}

template <int Most>
void FixedDigits<Most>::drop(std::int64_t words) {
  if (words <= 0) return;
  const auto out = static_cast<std::size_t>(std::min<std::int64_t>(words, size_));
  const bool exact = are_zero(limbs_, out);
  std::move(limbs_.begin() + static_cast<std::ptrdiff_t>(out), limbs_.begin() + size_, limbs_.begin());
  size_ -= static_cast<int>(out);
  exponent_ += words;
  error_ = (error_ != 0 ? 1 : 0) + (exact ? 0 : 1);
}

template <int Most>
FixedDigits<Most>& FixedDigits<Most>::operator<<=(unsigned shift) {
  exponent_ += shift / 64;
  const unsigned bits = shift % 64;
  if (bits == 0) return *this;
  std::array<mp_limb_t, static_cast<std::size_t>(Most) + 1> shifted;
  int size = size_;
  if (size > 0) {
    const mp_limb_t carry = mpn_lshift(shifted.data(), limbs_.data(), size, bits);
    if (carry != 0) shifted[static_cast<std::size_t>(size++)] = carry;
  }
  const bool fits = size <= Most && std::bit_width(error_) + static_cast<int>(bits) <= error_bits;
  const int out = fits ? 0 : 1;
  error_ = fits ? error_ << bits
                : (error_ == 0 ? 0 : (error_ >> (64 - bits)) + 1) + (size > 0 && shifted[0] != 0 ? 1 : 0);
  exponent_ += out;
  size_ = std::max(size - out, 0);
  std::copy_n(shifted.begin() + out, size_, limbs_.begin());
  return *this;
}

template <int Most>
FixedDigits<Most> FixedDigits<Most>::product(const FixedDigits& a, const FixedDigits& b, std::int64_t floor) {
  FixedDigits result;
  if (a.is_zero() || b.is_zero()) return result;
  result.exponent_ = a.exponent_ + b.exponent_;
  result.negative_ = a.negative_ != b.negative_;
  const int both = a.size_ + b.size_;
  // The number of words to drop: those without room, and those that errors make meaningless.
  std::int64_t out = std::max(0, both - Most);
  if (b.error_ != 0) out = std::max<std::int64_t>(out, a.size_ - 1);
  if (a.error_ != 0) out = std::max<std::int64_t>(out, b.size_ - 1);
  out = std::max(out, floor - result.exponent_);
  // |ab - a'b'| <= |a'| db + |b'| da + da db, plus 1 for the dropped words.
  Wide error;
  while (true) {
    error = times(a, b.error_, out) + times(b, a.error_, out) + over(Wide{a.error_} * b.error_, out) +
            (out > 0 ? 1 : 0);
    if (error >> error_bits == 0) break;
    ++out;
  }
  result.exponent_ += out;
  result.error_ = static_cast<std::uint64_t>(error);
  if (a.size_ == 0 || b.size_ == 0 || out >= both) return result;
  // Skip words of a and b that affect the result only through a carry. This adds at most 1 to the error.
  const int kept = both - static_cast<int>(out) + 1;
  const int of_a = std::min(a.size_, kept), of_b = std::min(b.size_, kept);
  const int below = (a.size_ - of_a) + (b.size_ - of_b);
  if (below > 0) ++result.error_;
  std::array<mp_limb_t, 2 * static_cast<std::size_t>(Most)> words;
  const mp_limb_t *from_a = a.limbs_.data() + (a.size_ - of_a), *from_b = b.limbs_.data() + (b.size_ - of_b);
  if (of_a >= of_b) {
    mpn_mul(words.data(), from_a, of_a, from_b, of_b);
  } else {
    mpn_mul(words.data(), from_b, of_b, from_a, of_a);
  }
  const std::ptrdiff_t first = out - below;
  result.size_ = static_cast<int>(of_a + of_b - first);
  std::copy(words.begin() + first, words.begin() + of_a + of_b, result.limbs_.begin());
  result.strip();
  return result;
}

template <int Most>
FixedDigits<Most>& FixedDigits<Most>::operator+=(const FixedDigits& other) {
  if (other.is_zero()) return *this;
  if (is_zero()) return *this = other;
  const std::int64_t top = std::max(exponent_ + size_, other.exponent_ + other.size_);
  std::int64_t last = std::max(std::min(exponent_, other.exponent_), top - Most);
  if (error_ != 0) last = std::max(last, exponent_);
  if (other.error_ != 0) last = std::max(last, other.exponent_);
  // Align both numbers to words from `last` upwards.
  const auto align = [last](FixedDigits& x) {
    x.drop(last - x.exponent_);
    const std::int64_t up = x.exponent_ - last;
    if (up > 0 && x.size_ > 0) {
      std::move_backward(x.limbs_.begin(), x.limbs_.begin() + x.size_, x.limbs_.begin() + x.size_ + up);
      std::fill_n(x.limbs_.begin(), up, 0);
      x.size_ += static_cast<int>(up);
    }
    x.exponent_ = last;
  };
  FixedDigits more = other;
  align(*this);
  align(more);
  error_ += more.error_;
  if (negative_ == more.negative_) {
    if (size_ < more.size_) {
      std::swap(limbs_, more.limbs_);
      std::swap(size_, more.size_);
    }
    const mp_limb_t carry =
        more.size_ == 0 ? 0 : mpn_add(limbs_.data(), limbs_.data(), size_, more.limbs_.data(), more.size_);
    if (carry != 0) {
      if (size_ == Most) drop(1);
      limbs_[static_cast<std::size_t>(size_++)] = carry;
    }
  } else {
    const bool less = size_ != more.size_
                          ? size_ < more.size_
                          : size_ > 0 && mpn_cmp(limbs_.data(), more.limbs_.data(), size_) < 0;
    if (less) {
      std::swap(limbs_, more.limbs_);
      std::swap(size_, more.size_);
      negative_ = more.negative_;
    }
    if (more.size_ > 0) mpn_sub(limbs_.data(), limbs_.data(), size_, more.limbs_.data(), more.size_);
    strip();
  }
  if (error_ >> error_bits != 0) drop(1);
  return *this;
}

template class FixedDigits<4>;
template class FixedDigits<8>;
template class FixedDigits<16>;
template class FixedDigits<32>;

}  // namespace kds
