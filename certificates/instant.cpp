#include "certificates/instant.h"

#include <stdexcept>

namespace kds {

ExactTime exact_time(const ExactPolynomial& function, const FailureTime& time) {
  const Dyadic lower(time.lower);
  if (time.lower == time.upper) return ExactTime(lower);
  if (time.isolating) return {function, {lower, Dyadic(time.upper)}};
  ExactPolynomial simple = function.square_free();
  auto roots = isolate_roots(simple, lower, Dyadic(time.upper));
  if (time.ordinal >= roots.size()) throw std::logic_error("a failure time's bracket holds too few roots");
  return {std::move(simple), std::move(roots[time.ordinal])};
}

}  // namespace kds
