#pragma once
// How many rounds tests of random cases go.

#include <algorithm>

namespace kds::test {

/// All of them; a tenth, but at least so many, under the sanitizers, which are many times slower and look for
/// faults of memory, not of geometry.
template <class Count>
[[nodiscard]] constexpr Count rounds(Count all, [[maybe_unused]] Count least = 1) {
#ifdef KDS_SANITIZED
  return std::max(least, all / 10);
#else
  return all;
#endif
}

}  // namespace kds::test
