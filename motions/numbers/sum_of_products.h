#pragma once
// A sum of products a b + c d + ... Number types specialize this class if they can add a product faster than
// by forming the product first.

#include <utility>

namespace kds {

template <class Number>
class SumOfProducts {
 public:
  constexpr SumOfProducts(const Number& a, const Number& b) : sum_(a * b) {}
  constexpr void add(const Number& a, const Number& b) { sum_ += a * b; }
  [[nodiscard]] constexpr Number value() && { return std::move(sum_); }

 private:
  Number sum_;
};

}  // namespace kds
