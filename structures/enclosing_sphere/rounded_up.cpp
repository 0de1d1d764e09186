#include "structures/enclosing_sphere/rounded_up.h"

#include <algorithm>
#include <limits>

namespace kds {

// Differences err by u = 2^-53 of themselves, their squares' sum by 5u and its root by 4u in all, unless
// squares over- or underflow. Then differences are brought near 1 first: what of them is lost below 2^-1000
// is less than the rest's roundings, and what is rounded on the way back, where numbers are subnormal, is
// made up for by the next larger number.
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
