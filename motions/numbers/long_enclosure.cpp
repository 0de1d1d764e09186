#include "motions/numbers/long_enclosure.h"

#include <algorithm>

namespace kds {

namespace {

std::size_t width_of(const Integer& x) { return x == 0 ? 0 : mpz_sizeinbase(x.backend().data(), 2); }

void shift_down(Integer& x, std::size_t bits) {
  mpz_tdiv_q_2exp(x.backend().data(), x.backend().data(), bits);
}

}  // namespace

LongEnclosure::LongEnclosure(const Enclosure& number)
    : value_(static_cast<std::uint64_t>(number.magnitude >> 64U)),
      error_(number.error),
      exponent_(number.exponent),
      most_bits_(Enclosure::most_bits) {
  value_ = (value_ << 64U) + static_cast<std::uint64_t>(number.magnitude);
  if (number.negative) value_ = -value_;
}

int LongEnclosure::certain_sign() const {
  return mpz_cmpabs(value_.backend().data(), error_.backend().data()) <= 0 ? 0 : value_.sign();
}

bool LongEnclosure::has_digits(std::size_t digits) const {
  return error_ == 0 || width_of(value_) > digits + width_of(error_);
}

LongEnclosure& LongEnclosure::operator+=(const LongEnclosure& other) {
  if (other.is_zero()) return *this;
  if (is_zero()) {
    value_ = other.value_;
    error_ = other.error_;
    exponent_ = other.exponent_;
    return *this;
  }
  LongEnclosure low = other;
  low.most_bits_ = most_bits_ = std::min(most_bits_, other.most_bits_);
  if (exponent_ < low.exponent_) std::swap(*this, low);
  // What is more than `most_bits` below the upper one's leading digit is left out.
  const auto apart = static_cast<std::size_t>(exponent_ - low.exponent_);
  const std::size_t width = std::max(width_of(value_), width_of(error_));
  const std::size_t up = std::min(apart, most_bits_ - std::min(width, most_bits_));
  value_ <<= up;
  error_ <<= up;
  exponent_ -= static_cast<std::int64_t>(up);
  if (const std::size_t down = apart - up; down > 0) {
    shift_down(low.value_, down);
    shift_down(low.error_, down);
    low.error_ += 2;
  }
  value_ += low.value_;
  error_ += low.error_;
  cut();
  return *this;
}

LongEnclosure& LongEnclosure::operator*=(const LongEnclosure& other) {
  // |ab - a'b'| <= |a'| db + (|b'| + db) da
  if (error_ != 0 || other.error_ != 0)
    error_ = abs(value_) * other.error_ + (abs(other.value_) + other.error_) * error_;
  value_ *= other.value_;
  exponent_ += other.exponent_;
  most_bits_ = std::min(most_bits_, other.most_bits_);
  cut();
  return *this;
}

void LongEnclosure::cut() {
  const std::size_t width = std::max(width_of(value_), width_of(error_));
  if (width <= most_bits_) return;
  const std::size_t bits = width - most_bits_;
  if (error_ == 0 && mpz_scan1(value_.backend().data(), 0) >= bits) {
    shift_down(value_, bits);
  } else {
    shift_down(value_, bits);
    shift_down(error_, bits);
    error_ += 2;
  }
  exponent_ += static_cast<std::int64_t>(bits);
}

}  // namespace kds
