#pragma once
// A cache of the coefficients of ordinary (not wide) functions. The coefficients are formed from the beads
// each time that a function is searched, compared with other functions that fail near it, or evaluated after
// a nearby event. In busy regions, four of five requests find coefficients formed a moment ago. The key
// consists of all numbers that the function is made from, so entries never become invalid. recent_functions.h
// caches wide functions.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "motions/numbers/integer.h"

namespace kds {

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
  [[nodiscard]] static std::size_t place_of(const Key& key);

  std::vector<Known> known_;  // indexed by a hash of the numbers, the same in every run
};

}  // namespace kds
