#pragma once
// The exact functions that were asked for last. The same few beads' function is asked for again and again
// where doubles do not decide: searched, compared, its sign looked at after each event. What has been found
// out about it, digits, square-free part and roots, stays with it. A function is known by all numbers that it
// is made from, so that nothing ever goes out of date.

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "certificates/exact/exact_polynomial.h"

namespace kds {

class RecentFunctions {
 public:
  /// `formula` names the function's formula, `numbers` are all that go into it.
  [[nodiscard]] ExactPolynomial of(const void* formula, const std::vector<double>& numbers,
                                   std::unique_ptr<const CoefficientSource> source);

 private:
  struct Known {
    const void* formula;
    std::vector<double> numbers;
    ExactPolynomial function;
  };
  static constexpr std::size_t room = 256;  // by hash; a later one takes the place of an earlier one

  std::array<std::optional<Known>, room> known_;
};

/// Of the calling thread.
[[nodiscard]] RecentFunctions& recent_functions();

}  // namespace kds
