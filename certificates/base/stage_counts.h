#pragma once
// How often each stage of the failure-time cascade had the last word.

#include <cstdint>

namespace kds {

struct StageCounts {
  std::uint64_t tolerance = 0;     ///< beads moved less than what was proved tolerable at an earlier frame
  std::uint64_t coefficients = 0;  ///< all Bernstein coefficients certainly positive: never fails
  std::uint64_t isolation =
      0;                      ///< signs in double: never fails, does not hold now, or a bracket with one root
  std::uint64_t refined = 0;  ///< the same with errors followed operation by operation
  std::uint64_t exact = 0;    ///< integers
  std::uint64_t shared = 0;   ///< settled with another one that has the same function
  std::uint64_t identically_zero = 0;  ///< integers, and the function is the zero polynomial: never fails
  std::uint64_t signs_double = 0;      ///< signs just after a time, settled in double
  std::uint64_t signs_exact = 0;
  std::uint64_t largest_bits = 0;  ///< longest coefficient an exact stage met
};

}  // namespace kds
