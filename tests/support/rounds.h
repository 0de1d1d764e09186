#pragma once
// Sets how many cases tests try in normal builds and under the sanitizers.

#include <algorithm>
#include <cstddef>

namespace kds::test {

/// Returns all rounds in normal builds. Returns a tenth, but at least the given minimum, under the
/// sanitizers, which are much slower and look for memory faults rather than geometric faults.
template <class Count>
[[nodiscard]] constexpr Count rounds(Count all, [[maybe_unused]] Count least = 1) {
#ifdef KDS_SANITIZED
  return std::max(least, all / 10);
#else
  return all;
#endif
}

/// The step from place to place in a file that a test damages at each place. Normal builds try every place.
/// Under the sanitizers, tests `fuzz.readers.*` try thousands of damaged files of each format besides.
#ifdef KDS_SANITIZED
inline constexpr std::size_t step_of_places = 7;
#else
inline constexpr std::size_t step_of_places = 1;
#endif

}  // namespace kds::test
