#include <array>
#include <cstddef>
#include <cstdint>

#include "structures/blocks/block_loops.h"

#define KDS_BLOCK_TARGET gnu::hot  // a placeholder: no special instructions

namespace kds {

namespace {

using PlainRow = float __attribute__((vector_size(16)));
using PlainFlags = decltype(PlainRow{} < PlainRow{});  // -1 for true, else 0

inline PlainRow plain_row(const float* from) {
  PlainRow row;
  __builtin_memcpy(&row, from, sizeof row);
  return row;
}
inline unsigned plain_bits(const PlainFlags& flags) {
  const PlainFlags some = flags & PlainFlags{1, 2, 4, 8};
  const PlainFlags two = some | __builtin_shufflevector(some, some, 2, 3, 0, 1);
  return static_cast<unsigned>(two[0] | two[1]);
}

template <int Dimension, class Box>
inline unsigned meeting_children(const BlockNode<Dimension>& node, const Box& box) {
  unsigned bits = 0;
  for (std::size_t four = 0; four < children_of_node; four += 4) {
    PlainFlags meeting = PlainFlags{} - 1;
    for (std::size_t axis = 0; axis < Dimension; ++axis)
      meeting &= (plain_row(node.low[axis].data() + four) <= box.high[axis]) &
                 (plain_row(node.high[axis].data() + four) >= box.low[axis]);
    bits |= plain_bits(meeting) << four;
  }
  return bits;
}

template <int Dimension>
inline const GroupBoxes<Dimension>& spread_groups(const GroupBoxes<Dimension>& boxes) {
  return boxes;
}
template <int Dimension>
inline unsigned meeting_groups(const GroupBoxes<Dimension>& a, const GroupBoxes<Dimension>& b) {
  unsigned bits = 0;
  for (std::size_t g = 0; g < 4; ++g) {
    PlainFlags meeting = PlainFlags{} - 1;
    for (std::size_t axis = 0; axis < Dimension; ++axis)
      meeting &= (plain_row(b.low[axis].data()) <= a.high[axis][g]) &
                 (plain_row(b.high[axis].data()) >= a.low[axis][g]);
    bits |= plain_bits(meeting) << (4 * g);
  }
  return bits;
}

template <bool Equal, int Dimension>
inline unsigned near_beads(const Blocks<Dimension>& blocks, std::size_t i, std::size_t j, float limit) {
  unsigned bits = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    PlainRow square{};
    for (std::size_t axis = 0; axis < Dimension; ++axis) {
      const PlainRow d = plain_row(blocks.centers[axis] + j) - blocks.centers[axis][i + k];
      square = axis == 0 ? d * d : square + d * d;
    }
    PlainRow most = PlainRow{} + limit;
    if constexpr (!Equal) {
      const PlainRow reach = plain_row(blocks.radii + j) + blocks.radii[i + k];
      most = reach * reach;
    }
    bits |= plain_bits(square <= most) << (4 * k);
  }
  return bits;
}

template <bool Equal, int Dimension>
inline unsigned near_along(const Blocks<Dimension>& blocks, std::size_t i, std::size_t apart, float limit) {
  unsigned bits = 0;
  for (std::size_t four = 0; four < beads_in_block; four += 4) {
    PlainRow square{};
    for (std::size_t axis = 0; axis < Dimension; ++axis) {
      const float* from = blocks.centers[axis] + i + four;
      const PlainRow d = plain_row(from) - plain_row(from + apart);
      square = axis == 0 ? d * d : square + d * d;
    }
    PlainRow most = PlainRow{} + limit;
    if constexpr (!Equal) {
      const PlainRow reach = plain_row(blocks.radii + i + four + apart) + plain_row(blocks.radii + i + four);
      most = reach * reach;
    }
    bits |= plain_bits(square <= most) << four;
  }
  return bits;
}

template <int Dimension>
inline unsigned steps_ahead(const Blocks<Dimension>& blocks, std::size_t i,
                            const std::array<float, static_cast<std::size_t>(Dimension)>& along,
                            float least) {
  unsigned bits = 0;
  for (std::size_t four = 0; four < beads_in_block; four += 4) {
    PlainRow sum{};
    for (std::size_t axis = 0; axis < Dimension; ++axis) {
      const float* from = blocks.centers[axis] + i + four;
      const PlainRow ahead = (plain_row(from + 1) - plain_row(from)) * along[axis];
      sum = axis == 0 ? ahead : sum + ahead;
    }
    bits |= plain_bits(sum > least) << four;
  }
  return bits;
}

inline std::size_t append_bits(std::uint32_t* out, std::uint32_t base, unsigned bits) {
  std::size_t count = 0;
  for (; bits != 0; bits &= bits - 1) out[count++] = base + static_cast<std::uint32_t>(__builtin_ctz(bits));
  return count;
}

}  // namespace

}  // namespace kds

#include "structures/blocks/define_block_loops.h"

namespace kds::detail {

template <int Dimension>
const BlockLoops<Dimension>* plain_block_loops() {
  return &loops_here<Dimension>;
}
template const BlockLoops<2>* plain_block_loops<2>();
template const BlockLoops<3>* plain_block_loops<3>();

}  // namespace kds::detail
