#pragma once
// Long functions on lanes (lanes.h), each compiled in one file. They are compiled like KDS_LANES_TARGETS and
// once more for processors with AVX-512, which have twice the registers. Every version gives the same bits.

#include "motions/numbers/lanes.h"
#include "motions/numbers/processor.h"

namespace kds {

namespace detail {

inline const bool here_is_avx512 = processor_has_avx512();  // cached, since the check is slow

template <auto function>
struct LongLanes;
/// `function` is inlined into each version, so it must not be marked noinline itself.
template <class... P, void (*function)(P...)>
struct LongLanes<function> {
#if KDS_LANES_ARE_COMPILED_FOR_TARGETS && defined(KDS_NEEDS_AVX2)
  [[KDS_FOR_TARGET("avx2")]] static void with_avx2(P... arguments) { function(arguments...); }
  [[KDS_FOR_TARGET("arch=x86-64-v4")]] static void with_avx512(P... arguments) { function(arguments...); }
  static void call(P... arguments) { here_is_avx512 ? with_avx512(arguments...) : with_avx2(arguments...); }
#elif KDS_LANES_ARE_COMPILED_FOR_TARGETS
  [[gnu::target_clones("arch=x86-64-v4", "avx2", "default"), gnu::flatten, gnu::noinline]] static void call(
      P... arguments) {
    function(arguments...);
  }
#else
  static void call(P... arguments) { function(arguments...); }
#endif
};

}  // namespace detail

/// Calls `function` in the version for this processor. Its parameters must be references, spans or numbers.
template <auto function>
inline constexpr auto in_long_lanes = &detail::LongLanes<function>::call;

}  // namespace kds
