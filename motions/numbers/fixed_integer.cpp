#include "motions/numbers/fixed_integer.h"

#include <algorithm>

#include "motions/numbers/modular.h"

namespace kds {

FixedInteger& FixedInteger::operator+=(const FixedInteger& other) {
  std::uint64_t carry = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Wide sum = Wide{limbs_[i]} + other.limbs_[i] + carry;
    limbs_[i] = static_cast<std::uint64_t>(sum);
    carry = static_cast<std::uint64_t>(sum >> 64U);
  }
  return *this;
}

FixedInteger& FixedInteger::operator-=(const FixedInteger& other) {
  std::uint64_t carry = 1;
  for (std::size_t i = 0; i < count; ++i) {
    const Wide sum = Wide{limbs_[i]} + ~other.limbs_[i] + carry;
    limbs_[i] = static_cast<std::uint64_t>(sum);
    carry = static_cast<std::uint64_t>(sum >> 64U);
  }
  return *this;
}

FixedInteger& FixedInteger::operator*=(long long factor) { return *this = *this * FixedInteger(factor); }

FixedInteger& FixedInteger::operator<<=(unsigned shift) {
  const std::size_t limbs = shift / 64;
  const unsigned rest = shift % 64;
  for (std::size_t i = count; i-- > 0;) {
    const std::uint64_t high = i >= limbs ? limbs_[i - limbs] : 0;
    const std::uint64_t low = i > limbs ? limbs_[i - limbs - 1] : 0;
    limbs_[i] = rest == 0 ? high : (high << rest) | (low >> (64 - rest));
  }
  return *this;
}

std::size_t FixedInteger::significant() const {
  const std::uint64_t sign = is_negative() ? ~std::uint64_t{0} : 0;
  std::size_t limbs = count;
  while (limbs > 0 && limbs_[limbs - 1] == sign) --limbs;
  return limbs;
}

void FixedInteger::add_product(const FixedInteger& a, const FixedInteger& b) {
  const std::size_t of_a = a.significant(), of_b = b.significant();
  const FixedInteger& other = of_a <= of_b ? b : a;
  const FixedInteger& rows = of_a <= of_b ? a : b;
  const std::size_t limbs = std::min(of_a, of_b);
  for (std::size_t i = 0; i < limbs; ++i) {
    const std::uint64_t factor = rows.limbs_[i];
    std::uint64_t carry = 0;
    for (std::size_t j = 0; i + j < count; ++j) {
      const Wide sum = Wide{factor} * other.limbs_[j] + limbs_[i + j] + carry;
      limbs_[i + j] = static_cast<std::uint64_t>(sum);
      carry = static_cast<std::uint64_t>(sum >> 64U);
    }
  }
  if (!rows.is_negative()) return;
  // The skipped limbs of a negative factor amount to -2^(64 limbs).
  std::uint64_t carry = 1;
  for (std::size_t j = 0; limbs + j < count; ++j) {
    const Wide sum = Wide{limbs_[limbs + j]} + ~other.limbs_[j] + carry;
    limbs_[limbs + j] = static_cast<std::uint64_t>(sum);
    carry = static_cast<std::uint64_t>(sum >> 64U);
  }
}

Integer FixedInteger::whole_number() const {
  const bool negative = is_negative();
  const FixedInteger magnitude = negative ? -*this : *this;
  Integer result;
  mpz_import(result.get_mpz_t(), count, -1, sizeof(std::uint64_t), 0, 0, magnitude.limbs_.data());
  if (negative) result = -result;
  return result;
}

}  // namespace kds
