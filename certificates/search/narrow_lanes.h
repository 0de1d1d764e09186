#pragma once
// Four isolated descents narrowed at once: Halley on the local polynomials, guarded by the bracket of signs
// seen so far, then a bracket around the result whose ends are proved. No allocation.

#include <algorithm>
#include <array>
#include <cstddef>

#include "motions/numbers/bernstein.h"
#include "motions/numbers/lanes.h"

namespace kds {

/// Of a degree that is a constant, or (any_degree) known at run time.
template <int Degree>
using LanesCoefficients = decltype(Bernstein<Lanes, Degree>::scaled);

/// A polynomial on [0,1] as in BoundedPolynomial, and its part on [lower, upper], which is certainly positive
/// at lower, negative at upper, and has one root.
template <int Degree>
struct LanesDescent {
  LanesCoefficients<Degree> bernstein, part;
  Lanes value_error, local_error;
  Lanes lower, upper;
};

/// In place: the polynomial on [u, 1] from that on [0, 1]; the first coefficient becomes the value at u.
template <class Row>
[[gnu::always_inline]] inline Lanes casteljau(Row& c, const Lanes& u) {
  const Lanes v = Lanes(1) - u;
  for (std::size_t round = c.size() - 1; round > 0; --round) {
    for (std::size_t i = 0; i < round; ++i) c[i] = v * c[i] + u * c[i + 1];
  }
  return c[0];
}

namespace detail {

/// Odd and even powers apart: half as long a chain of operations as Horner's rule.
template <class Row>
[[gnu::always_inline]] inline Lanes value_of_powers(const Row& c, const Lanes& t, const Lanes& square) {
  if (c.size() == 1) return c[0];
  Lanes later = c[c.size() - 1], next = c[c.size() - 2];
  for (std::size_t k = c.size() - 2; k-- > 0;) {
    const Lanes sum = later * square + c[k];
    later = next;
    next = sum;
  }
  return next + t * later;
}

/// The derivative's coefficients, divided by `divisor`.
template <std::size_t N>
[[gnu::always_inline]] inline std::array<Lanes, N - 1> derivative(const std::array<Lanes, N>& c,
                                                                  double divisor) {
  std::array<Lanes, std::max<std::size_t>(N, 2) - 1> result;
  for (std::size_t k = 1; k < N; ++k) result[k - 1] = Lanes(static_cast<double>(k) / divisor) * c[k];
  return result;
}
[[nodiscard]] inline Coefficients<Lanes> derivative(const Coefficients<Lanes>& c, double divisor) {
  Coefficients<Lanes> result;
  result.resize(c.size() - 1);
  for (std::size_t k = 1; k < c.size(); ++k) result[k - 1] = Lanes(static_cast<double>(k) / divisor) * c[k];
  return result;
}

/// Near the descent of the polynomial with these coefficients on [0,1]; `slope` is its derivative there.
template <class Row>
[[gnu::always_inline]] inline Lanes halley(const Row& c, Lanes::Mask moving, Lanes& slope) {
  const std::size_t count = c.size();
  const int degree = static_cast<int>(count) - 1;
  // Where the control polygon descends through zero.
  Lanes place(0.0), left(0.0), right(-1.0);
  for (std::size_t k = 0; k + 1 < count; ++k) {
    const Lanes::Mask crosses = (c[k] > Lanes(0.0)) & (c[k + 1] <= Lanes(0.0));
    place = Lanes::choose(crosses, Lanes(static_cast<double>(k)), place);
    left = Lanes::choose(crosses, c[k], left);
    right = Lanes::choose(crosses, c[k + 1], right);
  }
  Lanes t = (place + left / (left - right)) * Lanes(1.0 / degree);
  Row power = c;  // coefficients of t^k, by forward differences
  for (std::size_t r = 1; r < count; ++r) {
    for (std::size_t i = count - 1; i >= r; --i) power[i] = power[i] - power[i - 1];
  }
  for (std::size_t k = 1; k + 1 < count; ++k)
    power[k] = Lanes(static_cast<double>(binomial(degree, static_cast<int>(k)))) * power[k];
  const auto first = derivative(power, 1);
  const auto second = derivative(first, 2);  // half of it; of a line none

  Lanes low(0.0), high(1.0);
  for (int iteration = 0; iteration < 40 && Lanes::any(moving); ++iteration) {
    const Lanes square = t * t;
    const Lanes value = value_of_powers(power, t, square);
    slope = value_of_powers(first, t, square);
    Lanes change = value / slope;
    if (count > 2) {
      const Lanes bend = value_of_powers(second, t, square);
      change = value * slope / (slope * slope - value * bend);
    }
    const Lanes::Mask before = value > Lanes(0.0);
    low = Lanes::choose(before, t, low);
    high = Lanes::choose(before, high, t);
    Lanes next = t - change;
    next = Lanes::choose((next >= low) & (next <= high), next, Lanes(0.5) * (low + high));
    const Lanes::Mask far = Lanes::abs(next - t) > Lanes(0x1p-16);  // the next step is far shorter
    t = Lanes::choose(moving, next, t);  // one that has arrived stays: more steps would bisect it away
    moving &= far;
  }
  return t;
}

}  // namespace detail

/// Narrows lower and upper of the wanted lanes.
template <int Degree>
[[KDS_LANES_TARGETS]] void narrow_lanes(LanesDescent<Degree>& descent, const Lanes::Mask& wanted) {
  Lanes slope(-1.0);
  // In units of the part, hence times its length below.
  const Lanes t = detail::halley(descent.part, wanted, slope);
  const Lanes length = descent.upper - descent.lower;
  const Lanes root = descent.lower + length * t;
  // Far enough on both sides for the signs to be certain, also where a later search starts; the part's own
  // ends are.
  const Lanes doubtful = Lanes(4.0) * descent.local_error * length / Lanes::abs(slope);
  Lanes reach = Lanes::max(doubtful, Lanes::max(length * Lanes(0x1p-40), root * Lanes(0x1p-50)));
  Lanes::Mask below = wanted;  // lanes whose lower end is still to be found
  Lanes::Mask above = wanted;
  for (int attempt = 0; attempt < 6 && (Lanes::any(below) || Lanes::any(above)); ++attempt) {
    const Lanes lower = root - reach;
    const Lanes upper = root + reach;
    auto at_lower = descent.bernstein, at_upper = descent.bernstein;
    const Lanes::Mask lower_proved =
        below & (lower > descent.lower) & (casteljau(at_lower, lower) > descent.value_error);
    const Lanes::Mask upper_proved =
        above & (upper < descent.upper) & (casteljau(at_upper, upper) < -descent.value_error);
    descent.lower = Lanes::choose(lower_proved, lower, descent.lower);
    descent.upper = Lanes::choose(upper_proved, upper, descent.upper);
    below &= ~lower_proved;
    above &= ~upper_proved;
    reach = reach * Lanes(16.0);
  }
}

}  // namespace kds
