#pragma once
// A cache of the most recently used functions, mainly wide ones. If doubles do not decide, the same few
// functions are requested again and again: to search them, to compare them, and to find their sign after each
// event. All that is found out about a function is kept with it: digits, square-free part and roots. The key
// consists of all numbers that the function is made from, so entries never become invalid.

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "certificates/exact/recent_coefficients.h"
#include "certificates/exact/wide_polynomial.h"

namespace kds {

class RecentFunctions {
 public:
  /// Returns the function with this formula and these numbers. `formula` is an address that names the
  /// formula; `numbers` must be all numbers that the formula takes. If `negative` is set, returns the
  /// negative of that function, which shares everything that is found out.
  [[nodiscard]] std::shared_ptr<const WidePolynomial> of(const void* formula,
                                                         const std::vector<double>& numbers,
                                                         std::unique_ptr<const CoefficientSource> source,
                                                         bool negative = false);

  /// Returns the cache of functions that are not wide.
  [[nodiscard]] RecentCoefficients& ordinary() { return ordinary_; }

 private:
  struct Known {
    const void* formula = nullptr;
    std::vector<double> numbers;
    std::shared_ptr<const WidePolynomial> function, negative;
  };
  /// The entries of one hash value. The hash covers only the numbers, so a few formulas share a shelf. It is
  /// the same in every run.
  struct Shelf {
    std::array<Known, 8> known;
    std::size_t oldest = 0;
  };

  std::array<Shelf, 64> shelves_;
  RecentCoefficients ordinary_;
};

}  // namespace kds
