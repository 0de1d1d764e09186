#include "structures/blocks/block_kernels.h"

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
const BlockKernels<Dimension>& block_kernels(VectorTarget target) {
  if (!is_available(target)) throw std::invalid_argument("this processor has no such vectors");
  switch (target) {
    case VectorTarget::plain:
      break;
    case VectorTarget::avx2:
      return *detail::avx2_block_kernels<Dimension>();
    case VectorTarget::avx512:
      return *detail::avx512_block_kernels<Dimension>();
  }
  return *detail::plain_block_kernels<Dimension>();
}

template const BlockKernels<2>& block_kernels<2>(VectorTarget);
template const BlockKernels<3>& block_kernels<3>(VectorTarget);

}  // namespace kds
