#pragma once
// The sum of products a b + c d + ...: number types that can add a product faster than by forming it first
// specialize this class.

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
