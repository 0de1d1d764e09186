#include "kds/proved_table.h"

#include "certificates/exact/exact_polynomial.h"

namespace kds {

ExactFunction function_with_root(double time) {
  // u - t, scaled: -t at u = 0, 1 - t at u = 1.
  const Dyadic root(time);
  const Integer one = Integer(1) << root.exponent();
  return std::make_shared<const ExactPolynomial>(
      std::vector<Integer>{-root.numerator(), one - root.numerator()});
}

}  // namespace kds
