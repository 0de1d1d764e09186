#pragma once
// Polynomials on u in [0,1] in *scaled* Bernstein form: scaled[k] = C(degree, k) * (k-th Bernstein
// coefficient),
//   p(u) = sum_k scaled[k] u^k (1-u)^(degree-k).
// In this form a product is a plain convolution without divisions, so any ring can be the number type:
// doubles, magnitudes with error bounds, integers. Operations are exact if the number type is.
//
// The degree is a constant of the type. A negative constant -m stands for m times a degree known only at run
// time. Degrees of sums and products follow by the same arithmetic in both cases.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace kds {

/// The highest degree of functions that can be searched. Binomials of a higher degree exceed 64 bits while
/// they are computed.
inline constexpr int most_degree_of_function = 61;

/// Returns n over k, for n <= most_degree_of_function.
[[nodiscard]] constexpr std::int64_t binomial(int n, int k) {
  std::int64_t result = 1;
  for (int i = 1; i <= k; ++i) result = result * (n - k + i) / i;
  return result;
}

/// The degree constant of a motion whose degree is known only at run time.
inline constexpr int any_degree = -1;

/// A row of plain numbers whose length is known only when the program runs (small-vector). Short rows lie in
/// the object itself and cost no allocation; a copy costs as many numbers as there are.
template <class Number>
class PlainCoefficients {
  static_assert(std::is_trivially_copyable_v<Number>);

 public:
  static constexpr std::size_t room = 48;  ///< norms of cubic motion have 37

  PlainCoefficients() {}
  PlainCoefficients(const PlainCoefficients& other) { *this = other; }
  [[gnu::noinline]] PlainCoefficients& operator=(const PlainCoefficients& other) {
    if (this == &other) return *this;
    resize(other.size_);
    std::copy_n(other.begin(), size_, begin());
    return *this;
  }
  ~PlainCoefficients() = default;

  /// Keeps the numbers there are; new ones are not set to anything.
  [[gnu::noinline]] void resize(std::size_t size) {
    if (size > room && size > size_) {
      auto more = std::make_unique<Number[]>(size);
      std::copy_n(begin(), size_, more.get());
      more_ = std::move(more);
    }
    size_ = size;
  }
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] Number* begin() {
    return more_ ? more_.get() : std::launder(reinterpret_cast<Number*>(few_));
  }
  [[nodiscard]] const Number* begin() const {
    return more_ ? more_.get() : std::launder(reinterpret_cast<const Number*>(few_));
  }
  [[nodiscard]] Number* end() { return begin() + size_; }
  [[nodiscard]] const Number* end() const { return begin() + size_; }
  [[nodiscard]] Number& operator[](std::size_t i) { return begin()[i]; }
  [[nodiscard]] const Number& operator[](std::size_t i) const { return begin()[i]; }
  [[nodiscard]] const Number& back() const { return begin()[size_ - 1]; }

 private:
  std::size_t size_ = 0;
  std::unique_ptr<Number[]> more_;
  alignas(Number) std::byte few_[room * sizeof(Number)];  // not initialized
};

/// A row of numbers of any type.
template <class Number>
using Coefficients =
    std::conditional_t<std::is_trivially_copyable_v<Number>, PlainCoefficients<Number>, std::vector<Number>>;

/// A sum of products a b + c d + ... Number types specialize this class if they can add a product faster than
/// by forming the product first.
template <class Number>
class SumOfProducts {
 public:
  constexpr SumOfProducts(const Number& a, const Number& b) : sum_(a * b) {}
  constexpr void add(const Number& a, const Number& b) { sum_ += a * b; }
  [[nodiscard]] constexpr Number value() && { return std::move(sum_); }

 private:
  Number sum_;
};

namespace detail {

// Polynomials with run-time degrees share the code below, whatever multiple their types name.

template <class Number>
void require_like_degrees(const Coefficients<Number>& a, const Coefficients<Number>& b) {
  if (a.size() != b.size()) [[unlikely]]
    throw std::logic_error("polynomials of " + std::to_string(a.size()) + " and " + std::to_string(b.size()) +
                           " coefficients are added: write them with one degree first");
}

/// Adds in place. Throws std::logic_error if the numbers of coefficients differ; so does subtract_from.
template <class Number>
[[gnu::noinline]] void add_to(Coefficients<Number>& a, const Coefficients<Number>& b) {
  require_like_degrees<Number>(a, b);
  for (std::size_t k = 0; k < a.size(); ++k) a[k] += b[k];
}
template <class Number>
[[gnu::noinline]] void subtract_from(Coefficients<Number>& a, const Coefficients<Number>& b) {
  require_like_degrees<Number>(a, b);
  for (std::size_t k = 0; k < a.size(); ++k) a[k] -= b[k];
}
template <class Number>
[[gnu::noinline]] void negate(Coefficients<Number>& a) {
  for (Number& c : a) c = -std::move(c);
}

/// Returns coefficient k of the product a b.
template <class Number, class A, class B>
constexpr Number convolved(const A& a, const B& b, std::size_t k) {
  const std::size_t to_a = a.size() - 1, to_b = b.size() - 1;
  const std::size_t first = k > to_b ? k - to_b : 0;
  const std::size_t last = k < to_a ? k : to_a;
  SumOfProducts<Number> sum(a[first], b[k - first]);
  for (std::size_t i = first + 1; i <= last; ++i) sum.add(a[i], b[k - i]);
  return std::move(sum).value();
}
template <class Number>
[[gnu::noinline]] void multiply(const Coefficients<Number>& a, const Coefficients<Number>& b,
                                Coefficients<Number>& product) {
  product.resize(a.size() + b.size() - 1);
  for (std::size_t k = 0; k < product.size(); ++k) product[k] = convolved<Number>(a, b, k);
}

/// Elevates `p` to the degree `to`.
template <class Number>
[[gnu::noinline]] void elevate_to(std::size_t to, const Coefficients<Number>& p,
                                  Coefficients<Number>& result) {
  result.resize(to + 1);
  std::copy(p.begin(), p.end(), result.begin());
  for (std::size_t degree = p.size() - 1; degree < to; ++degree) {
    result[degree + 1] = result[degree];
    for (std::size_t k = degree; k > 0; --k) result[k] += result[k - 1];
  }
}

/// Multiplies a number by a whole number.
template <class Number>
constexpr void multiply_by(Number& x, std::int64_t factor) {
  if constexpr (std::is_floating_point_v<Number>) {
    x *= static_cast<Number>(factor);
  } else if constexpr (requires { Number::constant(1.0); }) {
    x = Number::constant(static_cast<double>(factor)) * x;
  } else if constexpr (requires { x *= static_cast<long>(factor); }) {  // GMP takes no long long
    x *= static_cast<long>(factor);
  } else {
    x = Number{static_cast<double>(factor)} * x;
  }
}

}  // namespace detail

template <class NumberType, int DegreeValue>
struct Bernstein {
  using Number = NumberType;
  static constexpr int degree = DegreeValue;

  std::conditional_t<(DegreeValue < 0), Coefficients<Number>,
                     std::array<Number, static_cast<std::size_t>(std::max(DegreeValue, 0)) + 1>>
      scaled;

  /// Makes room for the coefficients of this degree. If the type's degree is a constant, the argument must
  /// equal it.
  constexpr void set_degree([[maybe_unused]] int of_this_degree) {
    if constexpr (DegreeValue < 0) scaled.resize(static_cast<std::size_t>(of_this_degree) + 1);
  }

  constexpr Bernstein& operator+=(const Bernstein& other) {
    if constexpr (DegreeValue < 0) {
      detail::add_to<Number>(scaled, other.scaled);
    } else {
      for (std::size_t k = 0; k < scaled.size(); ++k) scaled[k] += other.scaled[k];
    }
    return *this;
  }
  constexpr Bernstein& operator-=(const Bernstein& other) {
    if constexpr (DegreeValue < 0) {
      detail::subtract_from<Number>(scaled, other.scaled);
    } else {
      for (std::size_t k = 0; k < scaled.size(); ++k) scaled[k] -= other.scaled[k];
    }
    return *this;
  }
  friend constexpr Bernstein operator+(Bernstein a, const Bernstein& b) { return a += b; }
  friend constexpr Bernstein operator-(Bernstein a, const Bernstein& b) { return a -= b; }
  friend constexpr Bernstein operator-(Bernstein a) {
    if constexpr (DegreeValue < 0) {
      detail::negate<Number>(a.scaled);
    } else {
      for (Number& c : a.scaled) c = -std::move(c);
    }
    return a;
  }
};

template <class Number, int A, int B>
constexpr Bernstein<Number, A + B> operator*(const Bernstein<Number, A>& a, const Bernstein<Number, B>& b) {
  Bernstein<Number, A + B> product;
  if constexpr (A + B < 0) {
    detail::multiply<Number>(a.scaled, b.scaled, product.scaled);
  } else {
    for (std::size_t k = 0; k < product.scaled.size(); ++k)
      product.scaled[k] = detail::convolved<Number>(a.scaled, b.scaled, k);
  }
  return product;
}

/// Returns the same polynomial written with a higher degree: p times a power of (u + (1-u)).
template <int To, class Number, int From>
constexpr Bernstein<Number, To> elevate(const Bernstein<Number, From>& p) {
  static_assert(From < 0 ? To <= From && To % From == 0 : To >= From);
  if constexpr (To == From) {
    return p;
  } else if constexpr (From < 0) {
    Bernstein<Number, To> result;
    detail::elevate_to<Number>((p.scaled.size() - 1) * static_cast<std::size_t>(To / From), p.scaled,
                               result.scaled);
    return result;
  } else {
    Bernstein<Number, From + 1> next;
    next.scaled[0] = p.scaled[0];
    for (std::size_t k = 1; k < p.scaled.size(); ++k) next.scaled[k] = p.scaled[k - 1] + p.scaled[k];
    next.scaled[static_cast<std::size_t>(From) + 1] = p.scaled[static_cast<std::size_t>(From)];
    return elevate<To>(next);
  }
}

/// Returns a whole number times a polynomial.
template <class Number, int Degree>
[[nodiscard]] constexpr Bernstein<Number, Degree> times(std::int64_t factor, Bernstein<Number, Degree> p) {
  for (Number& c : p.scaled) detail::multiply_by(c, factor);
  return p;
}

/// A vector of polynomials, one for each coordinate axis.
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
