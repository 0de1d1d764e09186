#include "motions/numbers/fixed_integer.h"

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

void FixedInteger::add_product(const FixedInteger& a, const FixedInteger& b) {
  // Two's complements multiply like numbers without sign, modulo 2^384.
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint64_t factor = a.limbs_[i];
    if (factor == 0) continue;
    std::uint64_t carry = 0;
    for (std::size_t j = 0; i + j < count; ++j) {
      const Wide sum = Wide{factor} * b.limbs_[j] + limbs_[i + j] + carry;
      limbs_[i + j] = static_cast<std::uint64_t>(sum);
      carry = static_cast<std::uint64_t>(sum >> 64U);
    }
  }
}

Integer FixedInteger::whole_number() const {
  const bool negative = limbs_.back() >> 63U != 0;
  const FixedInteger magnitude = negative ? -*this : *this;
  Integer result;
  mpz_import(result.backend().data(), count, -1, sizeof(std::uint64_t), 0, 0, magnitude.limbs_.data());
  if (negative) result = -result;
  return result;
}

}  // namespace kds
