#pragma once
// The coefficients of ordinary functions that were formed last. A function is searched, compared with others
// that fail near it, and its sign looked at after each event beside it, each time from its beads: where much
// happens at once, four times in five it was formed a moment ago. It is known by all numbers that it is made
// from, so that nothing ever goes out of date. (Wide functions: recent_functions.h.)

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "motions/numbers/integer.h"

namespace kds {

class RecentCoefficients {
 public:
  /// Of a function's formula, which has this name, and all numbers that go into it.
  struct Key {
    const void* formula;
    std::span<const double> numbers;
  };

  /// Null where they are not known, or not any more; valid until others are kept.
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

  std::vector<Known> known_;  // by their hash, which is that of the numbers: the same in every run
};

}  // namespace kds
