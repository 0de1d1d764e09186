#include "motions/numbers/rational.h"

#include <ostream>

namespace kds {

Rational::Rational(const Integer& numerator, const Integer& denominator) : Rational() {
  mpq_set_num(value_, numerator.data());
  mpq_set_den(value_, denominator.data());
  mpq_canonicalize(value_);
}

std::string Rational::str() const {
  const Integer below = denominator(*this);
  return numerator(*this).str() + (below == 1 ? std::string() : "/" + below.str());
}

std::ostream& operator<<(std::ostream& out, const Rational& value) { return out << value.str(); }

}  // namespace kds
