#pragma once
// Sets how many rounds tests of random cases run.

#include <algorithm>

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

}  // namespace kds::test
