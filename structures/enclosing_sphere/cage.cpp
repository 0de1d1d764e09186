#include "structures/enclosing_sphere/cage.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace kds {

// Differences have relative errors of u = 2^-53, the sum of their squares 5u, and its root 4u in all, unless
// squares overflow or underflow. In that case differences are scaled near 1 first. Underflow below 2^-1000
// then loses less than the other roundings. The rounding on the way back, if numbers are subnormal, is
// covered by taking the next larger number.
template <int Dimension>
double distance_rounded_up(const Point<Dimension>& a, const Point<Dimension>& b) {
  constexpr double up = 1 + 0x1p-49;
  Point<Dimension> d = detail::minus(a, b);
  double largest = 0;
  for (const double x : d) largest = std::max(largest, std::abs(x));
  if (largest == 0) return 0;
  if (!(largest <= std::numeric_limits<double>::max())) return std::numeric_limits<double>::infinity();
  if (largest >= 0x1p-450 && largest <= 0x1p450) return std::sqrt(detail::dot(d, d)) * up;
  const int exponent = std::ilogb(largest);
  for (double& x : d) x = std::ldexp(x, -exponent);
  return std::nextafter(std::ldexp(std::sqrt(detail::dot(d, d)) * up, exponent),
                        std::numeric_limits<double>::infinity());
}

template double distance_rounded_up<2>(const Point<2>&, const Point<2>&);
template double distance_rounded_up<3>(const Point<3>&, const Point<3>&);

}  // namespace kds
