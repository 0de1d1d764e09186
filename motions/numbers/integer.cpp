#include "motions/numbers/integer.h"

#include <ostream>
#include <stdexcept>

namespace kds {

Integer::Integer(const std::string& digits) {
  if (mpz_init_set_str(value_, digits.c_str(), 10) == 0) return;
  mpz_clear(value_);
  throw std::invalid_argument("no whole number: " + digits);
}

std::string Integer::str() const {
  std::string digits(mpz_sizeinbase(value_, 10) + 2, '\0');  // a sign and a zero at the end
  mpz_get_str(digits.data(), 10, value_);
  digits.resize(digits.find('\0'));
  return digits;
}

std::ostream& operator<<(std::ostream& out, const Integer& value) { return out << value.str(); }

Integer gcd(const Integer& a, const Integer& b) {
  Integer result;
  mpz_gcd(result.data(), a.data(), b.data());
  return result;
}

Integer lcm(const Integer& a, const Integer& b) {
  Integer result;
  mpz_lcm(result.data(), a.data(), b.data());
  return result;
}

Integer sqrt(const Integer& a) {
  Integer root;
  mpz_sqrt(root.data(), a.data());
  return root;
}

}  // namespace kds
