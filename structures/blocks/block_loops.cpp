#include "structures/blocks/block_loops.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <stdexcept>

#define KDS_BLOCK_TARGET gnu::hot  // a placeholder: no special instructions
#include "structures/blocks/define_block_loops.h"

namespace kds {

namespace {

struct Plain {
  using Flags = decltype(Row4{} < Row4{});  // -1 for true, else 0

  static unsigned bits_of(const Flags& flags) {
    const Flags some = flags & Flags{1, 2, 4, 8};
    const Flags two = some | __builtin_shufflevector(some, some, 2, 3, 0, 1);
    return static_cast<unsigned>(two[0] | two[1]);
  }

  template <int Dimension, class Box>
  static unsigned meeting_children(const BlockNode<Dimension>& node, const Box& box) {
    unsigned bits = 0;
    for (std::size_t four = 0; four < children_of_node; four += 4) {
      Flags meeting = Flags{} - 1;
      for (std::size_t axis = 0; axis < Dimension; ++axis)
        meeting &= (load_row(node.low[axis].data() + four) <= box.high[axis]) &
                   (load_row(node.high[axis].data() + four) >= box.low[axis]);
      bits |= bits_of(meeting) << four;
    }
    return bits;
  }

  template <int Dimension>
  static const GroupBoxes<Dimension>& spread_groups(const GroupBoxes<Dimension>& boxes) {
    return boxes;
  }
  template <int Dimension>
  static unsigned meeting_groups(const GroupBoxes<Dimension>& a, const GroupBoxes<Dimension>& b) {
    unsigned bits = 0;
    for (std::size_t g = 0; g < 4; ++g) {
      Flags meeting = Flags{} - 1;
      for (std::size_t axis = 0; axis < Dimension; ++axis)
        meeting &= (load_row(b.low[axis].data()) <= a.high[axis][g]) &
                   (load_row(b.high[axis].data()) >= a.low[axis][g]);
      bits |= bits_of(meeting) << (4 * g);
    }
    return bits;
  }

  template <bool Equal, int Dimension>
  static unsigned near_beads(const Blocks<Dimension>& blocks, std::size_t i, std::size_t j, float limit) {
    unsigned bits = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      Row4 square{};
      for (std::size_t axis = 0; axis < Dimension; ++axis) {
        const Row4 d = load_row(blocks.centers[axis] + j) - blocks.centers[axis][i + k];
        square = axis == 0 ? d * d : square + d * d;
      }
      Row4 most = Row4{} + limit;
      if constexpr (!Equal) {
        const Row4 reach = load_row(blocks.radii + j) + blocks.radii[i + k];
        most = reach * reach;
      }
      bits |= bits_of(square <= most) << (4 * k);
    }
    return bits;
  }

  template <bool Equal, int Dimension>
  static unsigned near_along(const Blocks<Dimension>& blocks, std::size_t i, std::size_t apart, float limit) {
    unsigned bits = 0;
    for (std::size_t four = 0; four < beads_in_block; four += 4) {
      Row4 square{};
      for (std::size_t axis = 0; axis < Dimension; ++axis) {
        const float* from = blocks.centers[axis] + i + four;
        const Row4 d = load_row(from) - load_row(from + apart);
        square = axis == 0 ? d * d : square + d * d;
      }
      Row4 most = Row4{} + limit;
      if constexpr (!Equal) {
        const Row4 reach = load_row(blocks.radii + i + four + apart) + load_row(blocks.radii + i + four);
        most = reach * reach;
      }
      bits |= bits_of(square <= most) << four;
    }
    return bits;
  }

  template <int Dimension>
  static unsigned steps_ahead(const Blocks<Dimension>& blocks, std::size_t i,
                              const std::array<float, static_cast<std::size_t>(Dimension)>& along,
                              float least) {
    unsigned bits = 0;
    for (std::size_t four = 0; four < beads_in_block; four += 4) {
      Row4 sum{};
      for (std::size_t axis = 0; axis < Dimension; ++axis) {
        const float* from = blocks.centers[axis] + i + four;
        const Row4 ahead = (load_row(from + 1) - load_row(from)) * along[axis];
        sum = axis == 0 ? ahead : sum + ahead;
      }
      bits |= bits_of(sum > least) << four;
    }
    return bits;
  }

  static std::size_t append_bits(std::uint32_t* out, std::uint32_t base, unsigned bits) {
    std::size_t count = 0;
    for (; bits != 0; bits &= bits - 1) out[count++] = base + static_cast<std::uint32_t>(__builtin_ctz(bits));
    return count;
  }
};

}  // namespace

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
  return loops_of<Plain, Dimension>;
}

template const BlockLoops<2>& block_loops<2>(VectorTarget);
template const BlockLoops<3>& block_loops<3>(VectorTarget);

}  // namespace kds
