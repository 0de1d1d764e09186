#pragma once
// How many rounds tests of random cases go.

namespace kds::test {

/// All of them; a tenth under the sanitizers, which are many times slower and look for faults of memory, not
/// of geometry.
template <class Count>
[[nodiscard]] constexpr Count rounds(Count all) {
#ifdef KDS_SANITIZED
  return all < 10 ? 1 : all / 10;
#else
  return all;
#endif
}

}  // namespace kds::test
