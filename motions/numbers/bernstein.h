#pragma once
// Polynomials on u in [0,1] in *scaled* Bernstein form: scaled[k] = C(Degree,k) * (k-th Bernstein
// coefficient),
//   p(u) = sum_k scaled[k] u^k (1-u)^(Degree-k).
// In this form a product is a plain convolution and nothing is ever divided, so every ring will do as Number:
// double, an error-bound magnitude, integers. Exact where Number is.

#include <array>
#include <cstddef>
#include <utility>

#include "motions/numbers/sum_of_products.h"

namespace kds {

/// n over k, for the small degrees of certificates.
[[nodiscard]] constexpr long long binomial(int n, int k) {
  long long result = 1;
  for (int i = 1; i <= k; ++i) result = result * (n - k + i) / i;
  return result;
}

template <class NumberType, int DegreeValue>
struct Bernstein {
  using Number = NumberType;
  static constexpr int degree = DegreeValue;

  std::array<Number, static_cast<std::size_t>(DegreeValue) + 1> scaled;

  constexpr Bernstein& operator+=(const Bernstein& other) {
    for (std::size_t k = 0; k < scaled.size(); ++k) scaled[k] += other.scaled[k];
    return *this;
  }
  constexpr Bernstein& operator-=(const Bernstein& other) {
    for (std::size_t k = 0; k < scaled.size(); ++k) scaled[k] -= other.scaled[k];
    return *this;
  }
  friend constexpr Bernstein operator+(Bernstein a, const Bernstein& b) { return a += b; }
  friend constexpr Bernstein operator-(Bernstein a, const Bernstein& b) { return a -= b; }
  friend constexpr Bernstein operator-(Bernstein a) {
    for (Number& c : a.scaled) c = -std::move(c);
    return a;
  }
};

template <class Number, int A, int B>
constexpr Bernstein<Number, A + B> operator*(const Bernstein<Number, A>& a, const Bernstein<Number, B>& b) {
  Bernstein<Number, A + B> product;
  for (std::size_t k = 0; k < product.scaled.size(); ++k) {
    const std::size_t first = k > B ? k - B : 0;
    const std::size_t last = k < A ? k : A;
    SumOfProducts<Number> sum(a.scaled[first], b.scaled[k - first]);
    for (std::size_t i = first + 1; i <= last; ++i) sum.add(a.scaled[i], b.scaled[k - i]);
    product.scaled[k] = std::move(sum).value();
  }
  return product;
}

/// The same polynomial written with a higher degree: multiplied by (u + (1-u)) again and again.
template <int To, class Number, int From>
constexpr Bernstein<Number, To> elevate(const Bernstein<Number, From>& p) {
  static_assert(To >= From);
  if constexpr (To == From) {
    return p;
  } else {
    Bernstein<Number, From + 1> next;
    next.scaled[0] = p.scaled[0];
    for (std::size_t k = 1; k < p.scaled.size(); ++k) next.scaled[k] = p.scaled[k - 1] + p.scaled[k];
    next.scaled[static_cast<std::size_t>(From) + 1] = p.scaled[static_cast<std::size_t>(From)];
    return elevate<To>(next);
  }
}

/// A vector of polynomials, one a coordinate axis.
template <class Number, int Degree, int Dimension>
using BernsteinVector = std::array<Bernstein<Number, Degree>, static_cast<std::size_t>(Dimension)>;

template <class Number, int A, int B, std::size_t N>
constexpr Bernstein<Number, A + B> dot(const std::array<Bernstein<Number, A>, N>& a,
                                       const std::array<Bernstein<Number, B>, N>& b) {
  Bernstein<Number, A + B> sum = a[0] * b[0];
  for (std::size_t axis = 1; axis < N; ++axis) sum += a[axis] * b[axis];
  return sum;
}

}  // namespace kds
