#pragma once
// a b + c d + ..., which some number types add up faster than one product after the other: they specialize
// this.

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
