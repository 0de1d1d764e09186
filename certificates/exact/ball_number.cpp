#include "certificates/exact/ball_number.h"

#include <flint/flint.h>
#if __FLINT_VERSION < 3
#include <arb.h>
#else
#include <flint/arb.h>
#endif

#include <algorithm>

namespace kds {

namespace {

static_assert(sizeof(arb_struct) == 6 * sizeof(std::uint64_t) &&
              alignof(arb_struct) <= alignof(std::uint64_t));

template <class Words>
auto arb(Words& words) {
  using Arb = std::conditional_t<std::is_const_v<Words>, const arb_struct, arb_struct>;
  return reinterpret_cast<Arb*>(words.data());
}

slong precision(std::size_t bits) {
  return bits == BallNumber::unlimited ? ARF_PREC_EXACT : static_cast<slong>(bits);
}

/// Rounds to the precision.
void round(arb_ptr x, std::size_t bits) {
  if (bits != BallNumber::unlimited) arb_set_round(x, x, precision(bits));
}

/// Returns an exponent, which Arb keeps as an integer of any size.
std::int64_t exponent(const fmpz& x) { return fmpz_get_si(&x); }

}  // namespace

BallNumber::BallNumber(std::size_t bits) : bits_(bits) { arb_init(arb(arb_)); }

BallNumber::BallNumber(const Integer& value, std::size_t bits) : BallNumber(bits) {
  arf_set_mpz(arb_midref(arb(arb_)), value.get_mpz_t());
  round(arb(arb_), bits);
}

BallNumber BallNumber::of(std::int64_t value, std::size_t bits) {
  BallNumber ball(bits);
  arb_set_si(arb(ball.arb_), value);
  round(arb(ball.arb_), bits);
  return ball;
}

BallNumber BallNumber::between(const Integer& low, const Integer& high, std::size_t bits) {
  BallNumber ball(high, unlimited), other(low, unlimited);
  arb_set_interval_arf(arb(ball.arb_), arb_midref(arb(other.arb_)), arb_midref(arb(ball.arb_)),
                       precision(bits));
  ball.bits_ = bits;
  return ball;
}

BallNumber BallNumber::around(const Integer& value, std::int64_t log_of_radius, std::size_t bits) {
  BallNumber ball(value, bits);
  arb_add_error_2exp_si(arb(ball.arb_), log_of_radius);
  return ball;
}

BallNumber::BallNumber(const BallNumber& other) : BallNumber(other.bits_) {
  arb_set(arb(arb_), arb(other.arb_));
}
BallNumber::BallNumber(BallNumber&& other) noexcept : BallNumber(other.bits_) {
  arb_swap(arb(arb_), arb(other.arb_));
}
BallNumber& BallNumber::operator=(const BallNumber& other) {
  arb_set(arb(arb_), arb(other.arb_));
  bits_ = other.bits_;
  return *this;
}
BallNumber& BallNumber::operator=(BallNumber&& other) noexcept {
  arb_swap(arb(arb_), arb(other.arb_));
  bits_ = other.bits_;
  return *this;
}
BallNumber::~BallNumber() { arb_clear(arb(arb_)); }

BallNumber BallNumber::rounded(std::size_t bits) const {
  BallNumber result = *this;
  result.bits_ = bits;
  round(arb(result.arb_), bits);
  return result;
}

int BallNumber::certain_sign() const {
  return arb_is_positive(arb(arb_)) ? 1 : arb_is_negative(arb(arb_)) ? -1 : 0;
}

bool BallNumber::is_zero() const { return arb_is_zero(arb(arb_)); }

bool BallNumber::has_digits(std::size_t digits) const {
  return arb_is_exact(arb(arb_)) || arb_rel_accuracy_bits(arb(arb_)) >= static_cast<slong>(digits);
}

std::int64_t BallNumber::top_bit() const {
  if (arb_is_exact(arb(arb_))) return exponent(*ARF_EXPREF(arb_midref(arb(arb_))));
  mag_t most;
  mag_init(most);
  arb_get_mag(most, arb(arb_));
  const std::int64_t top = exponent(*MAG_EXPREF(most));
  mag_clear(most);
  return top;
}

std::int64_t BallNumber::lowest_bit() const {
  const auto* mid = arb_midref(arb(arb_));
  return exponent(*ARF_EXPREF(mid)) - arf_bits(mid);
}

std::optional<std::int64_t> BallNumber::radius_bit() const {
  if (arb_is_exact(arb(arb_))) return std::nullopt;
  return exponent(*MAG_EXPREF(arb_radref(arb(arb_))));
}

Integer BallNumber::in_units(std::int64_t unit, Integer& error) const {
  arf_t scaled;
  fmpz_t whole;
  arf_init(scaled);
  fmpz_init(whole);
  Integer number, radius;
  arf_mul_2exp_si(scaled, arb_midref(arb(arb_)), -unit);
  const bool exact = arf_get_fmpz(whole, scaled, ARF_RND_FLOOR) == 0;
  fmpz_get_mpz(number.get_mpz_t(), whole);
  arf_set_mag(scaled, arb_radref(arb(arb_)));
  arf_mul_2exp_si(scaled, scaled, -unit);
  arf_get_fmpz(whole, scaled, ARF_RND_CEIL);
  fmpz_get_mpz(radius.get_mpz_t(), whole);
  arf_clear(scaled);
  fmpz_clear(whole);
  if (!exact) ++radius;
  if (radius > error) error = radius;
  return number;
}

void BallNumber::scale(std::int64_t power) { arb_mul_2exp_si(arb(arb_), arb(arb_), power); }

void BallNumber::share(std::size_t bits) { bits_ = std::min(bits_, bits); }

BallNumber& BallNumber::operator+=(const BallNumber& other) {
  share(other.bits_);
  arb_add(arb(arb_), arb(arb_), arb(other.arb_), precision(bits_));
  return *this;
}
BallNumber& BallNumber::operator-=(const BallNumber& other) {
  share(other.bits_);
  arb_sub(arb(arb_), arb(arb_), arb(other.arb_), precision(bits_));
  return *this;
}
BallNumber& BallNumber::operator*=(const BallNumber& other) {
  share(other.bits_);
  arb_mul(arb(arb_), arb(arb_), arb(other.arb_), precision(bits_));
  return *this;
}
BallNumber& BallNumber::operator*=(long long factor) {
  arb_mul_si(arb(arb_), arb(arb_), factor, precision(bits_));
  return *this;
}
BallNumber operator-(BallNumber a) {
  arb_neg(arb(a.arb_), arb(a.arb_));
  return a;
}

void add_product(BallNumber& sum, const BallNumber& a, const BallNumber& b) {
  sum.share(std::min(a.bits_, b.bits_));
  arb_addmul(arb(sum.arb_), arb(a.arb_), arb(b.arb_), precision(sum.bits_));
}

std::size_t limbs_of(const BallNumber& x) {
  if (x.bits_ != BallNumber::unlimited) return (x.bits_ - 1) / 64;
  return static_cast<std::size_t>(arb_bits(arb(x.arb_))) / 64 + 1;
}

}  // namespace kds
