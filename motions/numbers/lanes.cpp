#include "motions/numbers/lanes.h"

namespace kds {

std::optional<std::string> missing_in_processor() {
#if KDS_LANES_ARE_COMPILED_FOR_TARGETS && defined(KDS_NEEDS_AVX2)
  if (!__builtin_cpu_supports("avx2"))
    return "this processor has no AVX2, which kds was compiled for: build it with -DKDS_ANY_PROCESSOR=ON";
#endif
  return std::nullopt;
}

}  // namespace kds
