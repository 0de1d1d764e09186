#if defined(__x86_64__)

#define KDS_BLOCK_TARGET gnu::target("avx512f,avx2,popcnt")

#include <immintrin.h>

#include <array>
#include <cstddef>
#include <cstdint>

#include "structures/blocks/define_block_loops.h"

namespace kds {

namespace {

struct Avx512 {
  KDS_BLOCK_INLINE static __m512 four_by_four(const float* four) {
    return _mm512_maskz_broadcast_f32x4(0xffff, _mm_loadu_ps(four));
  }
  /// Broadcasts each of four numbers into four lanes.
  KDS_BLOCK_INLINE static __m512 each_four_times(const float* four) {
    const __m512i lane = _mm512_setr_epi32(0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3);
    return _mm512_maskz_permutevar_ps(0xffff, four_by_four(four), lane);
  }

  template <int Dimension, class Box>
  KDS_BLOCK_INLINE static unsigned meeting_children(const BlockNode<Dimension>& node, const Box& box) {
    __mmask16 bits = 0xffff;
    for (std::size_t axis = 0; axis < Dimension; ++axis) {
      bits = _mm512_mask_cmp_ps_mask(bits, _mm512_loadu_ps(node.low[axis].data()),
                                     _mm512_set1_ps(box.high[axis]), _CMP_LE_OQ);
      bits = _mm512_mask_cmp_ps_mask(bits, _mm512_loadu_ps(node.high[axis].data()),
                                     _mm512_set1_ps(box.low[axis]), _CMP_GE_OQ);
    }
    return bits;
  }

  using Floats = float __attribute__((vector_size(64)));
  /// The bounds of the four groups of a block. Lanes 4g to 4g + 3 have those of group g.
  template <int Dimension>
  struct SpreadGroups {
    std::array<Floats, static_cast<std::size_t>(Dimension)> low, high;
  };
  template <int Dimension>
  KDS_BLOCK_INLINE static SpreadGroups<Dimension> spread_groups(const GroupBoxes<Dimension>& boxes) {
    SpreadGroups<Dimension> spread;
    for (std::size_t axis = 0; axis < Dimension; ++axis) {
      spread.low[axis] = each_four_times(boxes.low[axis].data());
      spread.high[axis] = each_four_times(boxes.high[axis].data());
    }
    return spread;
  }
  template <int Dimension>
  KDS_BLOCK_INLINE static unsigned meeting_groups(const SpreadGroups<Dimension>& a,
                                                  const GroupBoxes<Dimension>& b) {
    __mmask16 bits = 0xffff;
    for (std::size_t axis = 0; axis < Dimension; ++axis) {
      bits = _mm512_mask_cmp_ps_mask(bits, a.low[axis], four_by_four(b.high[axis].data()), _CMP_LE_OQ);
      bits = _mm512_mask_cmp_ps_mask(bits, a.high[axis], four_by_four(b.low[axis].data()), _CMP_GE_OQ);
    }
    return bits;
  }

  template <bool Equal, int Dimension>
  KDS_BLOCK_INLINE static unsigned near_beads(const Blocks<Dimension>& blocks, std::size_t i, std::size_t j,
                                              float limit) {
    __m512 square = _mm512_setzero_ps();
    for (std::size_t axis = 0; axis < Dimension; ++axis) {
      const __m512 d =
          _mm512_sub_ps(four_by_four(blocks.centers[axis] + j), each_four_times(blocks.centers[axis] + i));
      square = axis == 0 ? _mm512_mul_ps(d, d) : _mm512_add_ps(square, _mm512_mul_ps(d, d));
    }
    __m512 most = _mm512_set1_ps(limit);
    if constexpr (!Equal) {
      const __m512 reach = _mm512_add_ps(four_by_four(blocks.radii + j), each_four_times(blocks.radii + i));
      most = _mm512_mul_ps(reach, reach);
    }
    return _mm512_cmp_ps_mask(square, most, _CMP_LE_OQ);
  }

  template <bool Equal, int Dimension>
  KDS_BLOCK_INLINE static unsigned near_along(const Blocks<Dimension>& blocks, std::size_t i,
                                              std::size_t apart, float limit) {
    __m512 square = _mm512_setzero_ps();
    for (std::size_t axis = 0; axis < Dimension; ++axis) {
      const __m512 d = _mm512_sub_ps(_mm512_loadu_ps(blocks.centers[axis] + i),
                                     _mm512_loadu_ps(blocks.centers[axis] + i + apart));
      square = axis == 0 ? _mm512_mul_ps(d, d) : _mm512_add_ps(square, _mm512_mul_ps(d, d));
    }
    __m512 most = _mm512_set1_ps(limit);
    if constexpr (!Equal) {
      const __m512 reach =
          _mm512_add_ps(_mm512_loadu_ps(blocks.radii + i + apart), _mm512_loadu_ps(blocks.radii + i));
      most = _mm512_mul_ps(reach, reach);
    }
    return _mm512_cmp_ps_mask(square, most, _CMP_LE_OQ);
  }

  template <int Dimension>
  KDS_BLOCK_INLINE static unsigned steps_ahead(
      const Blocks<Dimension>& blocks, std::size_t i,
      const std::array<float, static_cast<std::size_t>(Dimension)>& along, float least) {
    __m512 sum = _mm512_setzero_ps();
    for (std::size_t axis = 0; axis < Dimension; ++axis) {
      const __m512 step = _mm512_sub_ps(_mm512_loadu_ps(blocks.centers[axis] + i + 1),
                                        _mm512_loadu_ps(blocks.centers[axis] + i));
      const __m512 ahead = _mm512_mul_ps(step, _mm512_set1_ps(along[axis]));
      sum = axis == 0 ? ahead : _mm512_add_ps(sum, ahead);
    }
    return _mm512_cmp_ps_mask(sum, _mm512_set1_ps(least), _CMP_GT_OQ);
  }

  KDS_BLOCK_INLINE static std::size_t append_bits(std::uint32_t* out, std::uint32_t base, unsigned bits) {
    const __m512i lane = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
    const __m512i numbers = _mm512_add_epi32(lane, _mm512_set1_epi32(static_cast<int>(base)));
    _mm512_storeu_si512(out, _mm512_maskz_compress_epi32(static_cast<__mmask16>(bits), numbers));
    return static_cast<std::size_t>(__builtin_popcount(bits));
  }
};

}  // namespace

}  // namespace kds

#else

#include "structures/blocks/block_loops.h"

#endif

namespace kds::detail {

template <int Dimension>
const BlockLoops<Dimension>* avx512_block_loops() {
#if defined(__x86_64__)
  return &loops_of<Avx512, Dimension>;
#else
  return nullptr;
#endif
}
template const BlockLoops<2>* avx512_block_loops<2>();
template const BlockLoops<3>* avx512_block_loops<3>();

}  // namespace kds::detail
