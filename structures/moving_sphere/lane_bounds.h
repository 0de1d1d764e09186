#pragma once
// Bounds of polynomials and curves on [0,1] by their Bernstein coefficients, four at once. The bounds are
// computed in double and rounded as written; the caller allows for the rounding.

#include <array>
#include <cmath>

#include "motions/numbers/bernstein.h"
#include "structures/enclosing_sphere/numbers_in_lanes.h"

namespace kds {

template <int N>
using PolynomialLanes = Bernstein<Lanes, N>;
template <int N, int Dimension>
using CurveLanes = BernsteinVector<Lanes, N, Dimension>;

[[gnu::always_inline]] inline Lanes root(const Lanes& square) { return NumberTraits<Lanes>::sqrt(square); }

template <int N>
[[gnu::always_inline]] inline Lanes coefficient(const PolynomialLanes<N>& p, std::size_t k) {
  const double by = 1.0 / static_cast<double>(binomial(N, static_cast<int>(k)));
  return p.scaled[k] * Lanes(by);
}
template <int N>
[[gnu::always_inline]] inline Lanes least(const PolynomialLanes<N>& p) {
  Lanes lowest = p.scaled[0];
  for (std::size_t k = 1; k <= N; ++k) lowest = Lanes::min(lowest, coefficient(p, k));
  return lowest;
}
template <int N>
[[gnu::always_inline]] inline Lanes most(const PolynomialLanes<N>& p) {
  Lanes highest = abs(p.scaled[0]);
  for (std::size_t k = 1; k <= N; ++k) highest = Lanes::max(highest, abs(coefficient(p, k)));
  return highest;
}

template <int N, std::size_t Size>
[[gnu::always_inline]] inline Lanes square(const std::array<PolynomialLanes<N>, Size>& v, std::size_t k) {
  Lanes sum = coefficient(v[0], k) * coefficient(v[0], k);
  for (std::size_t i = 1; i < Size; ++i) sum += coefficient(v[i], k) * coefficient(v[i], k);
  return sum;
}
/// Returns an upper bound of the length of a vector of polynomials on [0,1].
template <int N, std::size_t Size>
[[gnu::always_inline]] inline Lanes most(const std::array<PolynomialLanes<N>, Size>& v) {
  Lanes highest = square(v, 0);
  for (std::size_t k = 1; k <= N; ++k) highest = Lanes::max(highest, square(v, k));
  return root(highest);
}

/// A polynomial that vanishes at both ends is at most this share of its largest coefficient: 1 - u^N -
/// (1-u)^N <= 1 - 2^(1-N).
template <int N>
inline constexpr double share_between = [] {
  double share = 1;
  for (int k = 1; k < N; ++k) share /= 2;
  return 1 - share;
}();
/// Returns an upper bound like `most`, which is sharper if the polynomial nearly vanishes at both ends.
template <int N>
[[gnu::always_inline]] inline Lanes most_between(const PolynomialLanes<N>& p) {
  Lanes inner(0.0);
  for (std::size_t k = 1; k < N; ++k) inner = Lanes::max(inner, abs(coefficient(p, k)));
  return Lanes(share_between<N>) * inner + Lanes::max(abs(p.scaled[0]), abs(p.scaled[N]));
}
template <int N, std::size_t Size>
[[gnu::always_inline]] inline Lanes most_between(const std::array<PolynomialLanes<N>, Size>& v) {
  Lanes inner(0.0);
  for (std::size_t k = 1; k < N; ++k) inner = Lanes::max(inner, square(v, k));
  return Lanes(share_between<N>) * root(inner) + root(Lanes::max(square(v, 0), square(v, N)));
}

/// Returns a lower bound of the absolute value.
template <int N>
[[gnu::always_inline]] inline Lanes least_magnitude(const PolynomialLanes<N>& p) {
  const Lanes::Mask falls = p.scaled[0] < Lanes(0.0);
  Lanes lowest = abs(p.scaled[0]);
  for (std::size_t k = 1; k <= N; ++k) {
    const Lanes value = coefficient(p, k);
    lowest = Lanes::min(lowest, Lanes::choose(falls, -value, value));
  }
  return lowest;
}
/// Returns a lower bound of the length: the length of the projection on the sum of both ends.
template <int N, std::size_t Size>
[[gnu::always_inline]] inline Lanes least_length(const std::array<PolynomialLanes<N>, Size>& v) {
  std::array<Lanes, Size> along;
  for (std::size_t i = 0; i < Size; ++i) along[i] = v[i].scaled[0] + v[i].scaled[N];
  Lanes square(0.0), lowest(HUGE_VAL);
  for (const Lanes& x : along) square += x * x;
  for (std::size_t k = 0; k <= N; ++k) {
    Lanes projection(0.0);
    for (std::size_t i = 0; i < Size; ++i) projection += coefficient(v[i], k) * along[i];
    lowest = Lanes::min(lowest, projection);
  }
  return lowest / root(square);
}

}  // namespace kds
