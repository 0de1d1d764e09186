#pragma once
// The functions that were asked for last, first of all the wide ones. The same few beads' function is asked
// for again and again where doubles do not decide: searched, compared, its sign looked at after each event.
// What has been found out about it, digits, square-free part and roots, stays with it. A function is known by
// all numbers that it is made from, so that nothing ever goes out of date.

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "certificates/exact/recent_coefficients.h"
#include "certificates/exact/wide_polynomial.h"

namespace kds {

class RecentFunctions {
 public:
  /// `formula` names the function's formula, `numbers` are all that go into it. Or the `negative` of what
  /// these make, which shares what is found out with it.
  [[nodiscard]] std::shared_ptr<const WidePolynomial> of(const void* formula,
                                                         const std::vector<double>& numbers,
                                                         std::unique_ptr<const CoefficientSource> source,
                                                         bool negative = false);

  /// Of functions that are not wide.
  [[nodiscard]] RecentCoefficients& ordinary() { return ordinary_; }

 private:
  struct Known {
    const void* formula = nullptr;
    std::vector<double> numbers;
    std::shared_ptr<const WidePolynomial> function, negative;
  };
  /// Those of one hash, which is that of the numbers: the same in every run. A few formulas share them.
  struct Shelf {
    std::array<Known, 8> known;
    std::size_t oldest = 0;
  };

  std::array<Shelf, 64> shelves_;
  RecentCoefficients ordinary_;
};

}  // namespace kds
