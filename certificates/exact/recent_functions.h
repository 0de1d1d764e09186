#pragma once
// Caches of the most recently used functions. If doubles do not decide, the same few functions are requested
// again and again: to search them, to compare them, and to find their sign after each event. The key consists
// of all numbers that the function is made from, so entries never become invalid.

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "certificates/exact/wide_polynomial.h"
#include "motions/numbers/exact_number.h"

namespace kds {

/// A cache of the coefficients of ordinary (not wide) functions. In busy regions, four of five requests find
/// coefficients formed a moment ago.
class RecentCoefficients {
 public:
  /// The address that names a function's formula, and all numbers that the formula takes.
  struct Key {
    const void* formula;
    std::span<const double> numbers;
  };

  /// Returns null if the coefficients are not cached. The pointer is valid until the next call of keep().
  [[nodiscard]] const std::vector<Integer>* of(const Key& key) const;
  void keep(const Key& key, const std::vector<Integer>& coefficients);

 private:
  static constexpr std::size_t room = 1024;

  struct Known {
    const void* formula = nullptr;
    std::vector<double> numbers;
    std::vector<Integer> coefficients;
  };
  [[nodiscard]] static std::size_t entry_of(const Key& key);

  std::vector<Known> known_;  // indexed by a hash of the numbers, the same in every run
};

/// A cache of wide functions. All that is found out about a function is kept with it: digits, square-free
/// part and roots.
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
  /// The entries of one hash value. The hash covers only the numbers, so a few formulas share a shelf. The
  /// hash is the same in every run.
  struct Shelf {
    std::array<Known, 8> known;
    std::size_t oldest = 0;
  };

  std::array<Shelf, 64> shelves_;
  RecentCoefficients ordinary_;
};

}  // namespace kds
