#if defined(__x86_64__)

#define KDS_BLOCK_TARGET gnu::target("avx2,popcnt")

#include <immintrin.h>

#include <array>
#include <cstddef>
#include <cstdint>

#include "structures/blocks/define_block_loops.h"

namespace kds {

namespace {

/// Table: for each eight-bit mask, the positions of its set bits, one byte each.
inline constexpr auto bit_numbers = [] {
  std::array<std::uint64_t, 256> table{};
  for (std::size_t bits = 0; bits < table.size(); ++bits) {
    unsigned index = 0;
    for (std::uint64_t bit = 0; bit < 8; ++bit)
      if ((bits >> bit & 1) != 0) table[bits] |= bit << (8 * index++);
  }
  return table;
}();

struct Avx2 {
  KDS_BLOCK_INLINE static __m256 four_twice(const float* four) {
    return _mm256_broadcast_ps(reinterpret_cast<const __m128*>(four));
  }
  /// Broadcasts two of four numbers into four lanes each: the last two if `last`, else the first two.
  KDS_BLOCK_INLINE static __m256 each_four_times(const float* four, bool last) {
    return _mm256_permutevar_ps(four_twice(four), last ? _mm256_setr_epi32(2, 2, 2, 2, 3, 3, 3, 3)
                                                       : _mm256_setr_epi32(0, 0, 0, 0, 1, 1, 1, 1));
  }
  KDS_BLOCK_INLINE static unsigned bits_of_lanes(__m256 flags) {
    return static_cast<unsigned>(_mm256_movemask_ps(flags));
  }
  KDS_BLOCK_INLINE static __m256 meeting(__m256 low, __m256 high, __m256 other_low, __m256 other_high) {
    return _mm256_and_ps(_mm256_cmp_ps(low, other_high, _CMP_LE_OQ),
                         _mm256_cmp_ps(other_low, high, _CMP_LE_OQ));
  }

  template <int Dimension, class Box>
  KDS_BLOCK_INLINE static unsigned meeting_children(const BlockNode<Dimension>& node, const Box& box) {
    unsigned bits = 0;
    for (std::size_t half = 0; half < 2; ++half) {
      __m256 all = _mm256_setzero_ps();
      for (std::size_t axis = 0; axis < Dimension; ++axis) {
        const __m256 one = meeting(_mm256_loadu_ps(node.low[axis].data() + 8 * half),
                                   _mm256_loadu_ps(node.high[axis].data() + 8 * half),
                                   _mm256_set1_ps(box.low[axis]), _mm256_set1_ps(box.high[axis]));
        all = axis == 0 ? one : _mm256_and_ps(all, one);
      }
      bits |= bits_of_lanes(all) << (8 * half);
    }
    return bits;
  }

  using Floats = float __attribute__((vector_size(32)));
  /// Shuffles group g into the four lanes that its bits stand for.
  template <int Dimension>
  struct SpreadGroups {
    std::array<std::array<Floats, static_cast<std::size_t>(Dimension)>, 2> low, high;
  };
  template <int Dimension>
  KDS_BLOCK_INLINE static SpreadGroups<Dimension> spread_groups(const GroupBoxes<Dimension>& boxes) {
    SpreadGroups<Dimension> spread;
    for (std::size_t half = 0; half < 2; ++half) {
      for (std::size_t axis = 0; axis < Dimension; ++axis) {
        spread.low[half][axis] = each_four_times(boxes.low[axis].data(), half == 1);
        spread.high[half][axis] = each_four_times(boxes.high[axis].data(), half == 1);
      }
    }
    return spread;
  }
  template <int Dimension>
  KDS_BLOCK_INLINE static unsigned meeting_groups(const SpreadGroups<Dimension>& a,
                                                  const GroupBoxes<Dimension>& b) {
    unsigned bits = 0;
    for (std::size_t half = 0; half < 2; ++half) {
      __m256 all = _mm256_setzero_ps();
      for (std::size_t axis = 0; axis < Dimension; ++axis) {
        const __m256 one = meeting(a.low[half][axis], a.high[half][axis], four_twice(b.low[axis].data()),
                                   four_twice(b.high[axis].data()));
        all = axis == 0 ? one : _mm256_and_ps(all, one);
      }
      bits |= bits_of_lanes(all) << (8 * half);
    }
    return bits;
  }

  template <bool Equal, int Dimension>
  KDS_BLOCK_INLINE static unsigned near_beads(const Blocks<Dimension>& blocks, std::size_t i, std::size_t j,
                                              float limit) {
    unsigned bits = 0;
    for (std::size_t half = 0; half < 2; ++half) {
      __m256 square = _mm256_setzero_ps();
      for (std::size_t axis = 0; axis < Dimension; ++axis) {
        const __m256 d = _mm256_sub_ps(four_twice(blocks.centers[axis] + j),
                                       each_four_times(blocks.centers[axis] + i, half == 1));
        square = axis == 0 ? _mm256_mul_ps(d, d) : _mm256_add_ps(square, _mm256_mul_ps(d, d));
      }
      __m256 most = _mm256_set1_ps(limit);
      if constexpr (!Equal) {
        const __m256 reach =
            _mm256_add_ps(four_twice(blocks.radii + j), each_four_times(blocks.radii + i, half == 1));
        most = _mm256_mul_ps(reach, reach);
      }
      bits |= bits_of_lanes(_mm256_cmp_ps(square, most, _CMP_LE_OQ)) << (8 * half);
    }
    return bits;
  }

  template <bool Equal, int Dimension>
  KDS_BLOCK_INLINE static unsigned near_along(const Blocks<Dimension>& blocks, std::size_t i,
                                              std::size_t apart, float limit) {
    unsigned bits = 0;
    for (std::size_t half = 0; half < 2; ++half) {
      const std::size_t from = i + 8 * half;
      __m256 square = _mm256_setzero_ps();
      for (std::size_t axis = 0; axis < Dimension; ++axis) {
        const __m256 d = _mm256_sub_ps(_mm256_loadu_ps(blocks.centers[axis] + from),
                                       _mm256_loadu_ps(blocks.centers[axis] + from + apart));
        square = axis == 0 ? _mm256_mul_ps(d, d) : _mm256_add_ps(square, _mm256_mul_ps(d, d));
      }
      __m256 most = _mm256_set1_ps(limit);
      if constexpr (!Equal) {
        const __m256 reach =
            _mm256_add_ps(_mm256_loadu_ps(blocks.radii + from + apart), _mm256_loadu_ps(blocks.radii + from));
        most = _mm256_mul_ps(reach, reach);
      }
      bits |= bits_of_lanes(_mm256_cmp_ps(square, most, _CMP_LE_OQ)) << (8 * half);
    }
    return bits;
  }

  template <int Dimension>
  KDS_BLOCK_INLINE static unsigned steps_ahead(
      const Blocks<Dimension>& blocks, std::size_t i,
      const std::array<float, static_cast<std::size_t>(Dimension)>& along, float least) {
    unsigned bits = 0;
    for (std::size_t half = 0; half < 2; ++half) {
      const std::size_t from = i + 8 * half;
      __m256 sum = _mm256_setzero_ps();
      for (std::size_t axis = 0; axis < Dimension; ++axis) {
        const __m256 step = _mm256_sub_ps(_mm256_loadu_ps(blocks.centers[axis] + from + 1),
                                          _mm256_loadu_ps(blocks.centers[axis] + from));
        const __m256 ahead = _mm256_mul_ps(step, _mm256_set1_ps(along[axis]));
        sum = axis == 0 ? ahead : _mm256_add_ps(sum, ahead);
      }
      bits |= bits_of_lanes(_mm256_cmp_ps(sum, _mm256_set1_ps(least), _CMP_GT_OQ)) << (8 * half);
    }
    return bits;
  }

  KDS_BLOCK_INLINE static std::size_t append_bits(std::uint32_t* out, std::uint32_t base, unsigned bits) {
    std::size_t count = 0;
    for (std::uint32_t half = 0; half < 2; ++half) {
      const unsigned eight = bits >> (8 * half) & 0xff;
      const __m128i numbers = _mm_cvtsi64_si128(static_cast<long long>(bit_numbers[eight]));
      const __m256i from = _mm256_set1_epi32(static_cast<int>(base + 8 * half));
      _mm256_storeu_si256(reinterpret_cast<__m256i*>(out + count),
                          _mm256_add_epi32(_mm256_cvtepu8_epi32(numbers), from));
      count += static_cast<std::size_t>(__builtin_popcount(eight));
    }
    return count;
  }
};

}  // namespace

}  // namespace kds

#else

#include "structures/blocks/block_loops.h"

#endif

namespace kds::detail {

template <int Dimension>
const BlockLoops<Dimension>* avx2_block_loops() {
#if defined(__x86_64__)
  return &loops_of<Avx2, Dimension>;
#else
  return nullptr;
#endif
}
template const BlockLoops<2>* avx2_block_loops<2>();
template const BlockLoops<3>* avx2_block_loops<3>();

}  // namespace kds::detail
