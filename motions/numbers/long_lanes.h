#pragma once
// Long functions of lanes (lanes.h), that one file compiles: as KDS_LANES_TARGETS, and once more with twice
// the registers for processors that have so many. The same bits again.

#include "motions/numbers/lanes.h"
#include "motions/numbers/processor.h"

namespace kds {

namespace detail {

inline const bool here_is_avx512 = processor_has_avx512();  // it takes as long as some of the functions

template <auto function>
struct LongLanes;
/// The function is inlined into each, so that it must not be noinline itself.
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

/// `function`, of parameters that are references, spans or numbers.
template <auto function>
inline constexpr auto in_long_lanes = &detail::LongLanes<function>::call;

}  // namespace kds
