#include "structures/blocks/block_loops.h"

#include <stdexcept>

namespace kds {

bool is_available(VectorTarget target) {
#if defined(__x86_64__)
  switch (target) {
    case VectorTarget::plain:
      return true;
    case VectorTarget::avx2:
      return __builtin_cpu_supports("avx2") != 0;
    case VectorTarget::avx512:
      return __builtin_cpu_supports("avx512f") != 0;
  }
#endif
  return target == VectorTarget::plain;
}

VectorTarget widest_vector_target() {
  if (is_available(VectorTarget::avx512)) return VectorTarget::avx512;
  return is_available(VectorTarget::avx2) ? VectorTarget::avx2 : VectorTarget::plain;
}

template <int Dimension>
const BlockLoops<Dimension>& block_loops(VectorTarget target) {
  if (!is_available(target)) throw std::invalid_argument("this processor has no such vectors");
  switch (target) {
    case VectorTarget::plain:
      break;
    case VectorTarget::avx2:
      return *detail::avx2_block_loops<Dimension>();
    case VectorTarget::avx512:
      return *detail::avx512_block_loops<Dimension>();
  }
  return *detail::plain_block_loops<Dimension>();
}

template const BlockLoops<2>& block_loops<2>(VectorTarget);
template const BlockLoops<3>& block_loops<3>(VectorTarget);

}  // namespace kds
