#pragma once
// Defines the loops of block_loops.h. Each file that instantiates them, one per vector target, includes this
// header. Before the include, the file defines KDS_BLOCK_TARGET, the attribute of all these functions: an
// attribute cannot depend on a template argument. The file passes its operations as the struct `Target`:
//
//   meeting_children(node, box)       a bit for each child of the node that meets the box
//   spread_groups(a)                  the boxes of groups in the layout that meeting_groups takes
//   meeting_groups(spread, b)         bit 4 g + h: group g of the spread boxes meets group h of boxes b
//   near_beads<Equal>(blocks, i, j, limit)
//                                     bit 4 k + l: bead i + k is near bead j + l
//   near_along<Equal>(blocks, i, apart, limit)
//                                     bit k (of 16): bead i + k is near bead i + k + apart
//   steps_ahead(blocks, i, along, least)
//                                     bit k (of 16): bead i + k + 1 is ahead of bead i + k by more than
//                                     `least`, times the length of the vector `along`
//   append_bits(out, base, bits)      writes base + k for each set bit k, in order, and returns their number
//
// A compiler may inline these functions only into functions of their target, and code for other targets must
// not see them. The functions are therefore local to the file.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "motions/base/floating_point_scope.h"
#include "structures/blocks/block_loops.h"

#define KDS_BLOCK_INLINE [[gnu::always_inline, KDS_BLOCK_TARGET]] inline

namespace kds {

namespace {

using Row4 = float __attribute__((vector_size(16)));
using Doubles4 = double __attribute__((vector_size(32)));

KDS_BLOCK_INLINE Row4 smaller(const Row4& a, const Row4& b) { return a < b ? a : b; }
KDS_BLOCK_INLINE Row4 larger(const Row4& a, const Row4& b) { return a > b ? a : b; }
KDS_BLOCK_INLINE float least(const Row4& a) {
  const Row4 b = smaller(a, __builtin_shufflevector(a, a, 2, 3, 0, 1));
  return std::min(b[0], b[1]);
}
KDS_BLOCK_INLINE float greatest(const Row4& a) {
  const Row4 b = larger(a, __builtin_shufflevector(a, a, 2, 3, 0, 1));
  return std::max(b[0], b[1]);
}
KDS_BLOCK_INLINE Row4 load_row(const float* from) {
  Row4 row;
  __builtin_memcpy(&row, from, sizeof row);
  return row;
}
KDS_BLOCK_INLINE void store_row(float* to, const Row4& row) { __builtin_memcpy(to, &row, sizeof row); }

/// Returns four doubles, times a factor, plus a term, converted to floats.
KDS_BLOCK_INLINE Row4 floats_of(const double* from, double factor, double term) {
  Doubles4 four;
  __builtin_memcpy(&four, from, sizeof four);
  return __builtin_convertvector(four * factor + term, Row4);
}

// The hardware prefetcher stops at the end of a page, so later data is prefetched explicitly.
inline constexpr std::size_t doubles_fetched_ahead = 256;

/// Prefetches the doubles that lie doubles_fetched_ahead after bead `from`. The address may lie beyond the
/// end.
template <int Dimension>
KDS_BLOCK_INLINE void fetch_doubles(const BlockSource<Dimension>& source, std::size_t from) {
  constexpr std::size_t doubles_in_line = 8;
  for (const double* const axis : source.centers)
    for (std::size_t k = 0; k < beads_in_block; k += doubles_in_line)
      __builtin_prefetch(axis + from + doubles_fetched_ahead + k);
}

/// Transposes the rows: lane g of row k becomes number k of row g.
KDS_BLOCK_INLINE void transpose(std::array<Row4, 4>& rows) {
  const Row4 ab01 = __builtin_shufflevector(rows[0], rows[1], 0, 4, 1, 5);
  const Row4 ab23 = __builtin_shufflevector(rows[0], rows[1], 2, 6, 3, 7);
  const Row4 cd01 = __builtin_shufflevector(rows[2], rows[3], 0, 4, 1, 5);
  const Row4 cd23 = __builtin_shufflevector(rows[2], rows[3], 2, 6, 3, 7);
  rows = {__builtin_shufflevector(ab01, cd01, 0, 1, 4, 5), __builtin_shufflevector(ab01, cd01, 2, 3, 6, 7),
          __builtin_shufflevector(ab23, cd23, 0, 1, 4, 5), __builtin_shufflevector(ab23, cd23, 2, 3, 6, 7)};
}

template <int Dimension, bool Equal>
[[KDS_BLOCK_TARGET, gnu::noinline]] BlockExtent fill(const BlockSource<Dimension>& from_source,
                                                     std::size_t first, std::size_t last,
                                                     const Blocks<Dimension>& into_blocks,
                                                     BlockNode<Dimension>* parents) {
  // Local copies, so that the compiler knows that no store changes them.
  const Blocks<Dimension> blocks = into_blocks;
  const BlockSource<Dimension> source = from_source;
  const Row4 zero{};
  Row4 farthest = zero, widest = zero;
  std::array<Row4, 4> radius{zero + source.radius, zero, zero, zero};
  for (std::size_t b = first; b < last; ++b) {
    const std::size_t from = beads_in_block * (b - first);
    fetch_doubles(source, from);
    if constexpr (!Equal) {
      for (std::size_t g = 0; g < 4; ++g) {
        radius[g] = floats_of(source.radii + from + 4 * g, source.radius_factor, source.radius_added);
        store_row(blocks.radii + beads_in_block * b + 4 * g, radius[g]);
        widest = larger(widest, radius[g]);
      }
      transpose(radius);
    }
    BlockNode<Dimension>& parent = parents[b / children_of_node];
    const std::size_t index = b % children_of_node;
    for (std::size_t axis = 0; axis < Dimension; ++axis) {
      std::array<Row4, 4> rows;
      for (std::size_t g = 0; g < 4; ++g) {
        rows[g] = floats_of(source.centers[axis] + from + 4 * g, source.scale, -source.shift[axis]);
        store_row(blocks.centers[axis] + beads_in_block * b + 4 * g, rows[g]);
      }
      transpose(rows);
      Row4 low, high;
      if constexpr (Equal) {
        low = smaller(smaller(rows[0], rows[1]), smaller(rows[2], rows[3]));
        high = larger(larger(rows[0], rows[1]), larger(rows[2], rows[3]));
        farthest = larger(farthest, larger(high, -low));
        low -= radius[0];
        high += radius[0];
      } else {
        low = smaller(smaller(rows[0] - radius[0], rows[1] - radius[1]),
                      smaller(rows[2] - radius[2], rows[3] - radius[3]));
        high = larger(larger(rows[0] + radius[0], rows[1] + radius[1]),
                      larger(rows[2] + radius[2], rows[3] + radius[3]));
        for (const Row4& row : rows) farthest = larger(farthest, larger(row, -row));
      }
      store_row(blocks.boxes[b].low[axis].data(), low);
      store_row(blocks.boxes[b].high[axis].data(), high);
      parent.low[axis][index] = least(low);
      parent.high[axis][index] = greatest(high);
    }
  }
  return {greatest(farthest), Equal ? source.radius : greatest(widest)};
}

template <int Dimension>
[[KDS_BLOCK_TARGET, gnu::noinline]] float stray(const BlockSource<Dimension>& from_source, std::size_t first,
                                                std::size_t last, const Blocks<Dimension>& before) {
  const BlockSource<Dimension> source = from_source;
  Row4 farthest{};
  for (std::size_t b = first; b < last; ++b) {
    fetch_doubles(source, beads_in_block * (b - first));
    for (std::size_t g = 0; g < 4; ++g) {
      const std::size_t from = beads_in_block * (b - first) + 4 * g;
      Row4 square{};
      for (std::size_t axis = 0; axis < Dimension; ++axis) {
        const Row4 d = floats_of(source.centers[axis] + from, source.scale, -source.shift[axis]) -
                       load_row(before.centers[axis] + beads_in_block * b + 4 * g);
        square = axis == 0 ? d * d : square + d * d;
      }
      farthest = larger(square, farthest);  // keeps the second operand if one is NaN
    }
  }
  return greatest(farthest);
}

template <int Dimension>
[[KDS_BLOCK_TARGET, gnu::noinline]] void unite(const BlockNode<Dimension>* nodes, std::size_t first,
                                               std::size_t last, BlockNode<Dimension>* parents) {
  for (std::size_t n = first; n < last; ++n) {
    BlockNode<Dimension>& parent = parents[n / children_of_node];
    const std::size_t index = n % children_of_node;
    for (std::size_t axis = 0; axis < Dimension; ++axis) {
      const float* low = nodes[n].low[axis].data();
      const float* high = nodes[n].high[axis].data();
      parent.low[axis][index] = least(
          smaller(smaller(load_row(low), load_row(low + 4)), smaller(load_row(low + 8), load_row(low + 12))));
      parent.high[axis][index] = greatest(larger(larger(load_row(high), load_row(high + 4)),
                                                 larger(load_row(high + 8), load_row(high + 12))));
    }
  }
}

template <class Target, int Dimension>
[[KDS_BLOCK_TARGET, gnu::noinline]] void stretch(const Blocks<Dimension>& blocks, std::size_t first,
                                                 std::size_t last, float least, std::uint16_t* stretched) {
  constexpr std::size_t steps = 2 * beads_in_block - 1;
  const float shortest = static_cast<float>(steps) * least, shortest_square = shortest * shortest;
  for (std::size_t b = first; b < last; ++b) {
    const std::size_t bead = beads_in_block * b;
    std::array<float, static_cast<std::size_t>(Dimension)> along;
    float square = 0;
    for (std::size_t axis = 0; axis < Dimension; ++axis) {
      along[axis] = blocks.centers[axis][bead + steps] - blocks.centers[axis][bead];
      square += along[axis] * along[axis];
    }
    const float its_least = least * __builtin_sqrtf(square);
    // Bit 15 is the step into the block after these two, so it is ignored.
    const bool is = square > shortest_square &&
                    Target::steps_ahead(blocks, bead, along, its_least) == 0xffff &&
                    (Target::steps_ahead(blocks, bead + beads_in_block, along, its_least) | 0x8000) == 0xffff;
    std::uint16_t& bits = stretched[b / children_of_node];
    const unsigned bit = 1U << b % children_of_node;
    bits = static_cast<std::uint16_t>(is ? bits | bit : bits & ~bit);
  }
}

template <int Dimension>
struct ChildBox {
  std::array<float, static_cast<std::size_t>(Dimension)> low, high;
};
template <int Dimension>
KDS_BLOCK_INLINE ChildBox<Dimension> child_box(const BlockNode<Dimension>& node, std::size_t child) {
  ChildBox<Dimension> box;
  for (std::size_t axis = 0; axis < Dimension; ++axis) {
    box.low[axis] = node.low[axis][child];
    box.high[axis] = node.high[axis][child];
  }
  return box;
}
template <int Dimension>
KDS_BLOCK_INLINE ChildBox<Dimension> box_of(const BlockNode<Dimension>& node) {
  ChildBox<Dimension> box;
  for (std::size_t axis = 0; axis < Dimension; ++axis) {
    const float* low = node.low[axis].data();
    const float* high = node.high[axis].data();
    box.low[axis] = least(
        smaller(smaller(load_row(low), load_row(low + 4)), smaller(load_row(low + 8), load_row(low + 12))));
    box.high[axis] = greatest(
        larger(larger(load_row(high), load_row(high + 4)), larger(load_row(high + 8), load_row(high + 12))));
  }
  return box;
}

KDS_BLOCK_INLINE void write_sixteen(std::uint32_t* out, std::uint32_t number) {
  for (std::size_t k = 0; k < 16; ++k) out[k] = number;
}

template <class Target, int Dimension>
[[KDS_BLOCK_TARGET, gnu::noinline]] std::size_t expand(const BlockNode<Dimension>* nodes, std::uint32_t a,
                                                       std::uint32_t b, unsigned stretched, NodePairs found) {
  constexpr auto children = static_cast<std::uint32_t>(children_of_node);
  const BlockNode<Dimension>& first = nodes[a];
  const BlockNode<Dimension>& second = nodes[b];
  std::size_t count = 0;
  // Bits of the children of b that meet a's box, and of the children of a that meet b's box.
  unsigned others = 0xffff, ours = 0xffff;
  if (a != b) {
    ours = Target::meeting_children(first, box_of(second));
    if (ours == 0) return 0;
    others = Target::meeting_children(second, box_of(first));
  }
  for (; ours != 0; ours &= ours - 1) {
    const auto child = static_cast<std::uint32_t>(__builtin_ctz(ours));
    unsigned meeting = Target::meeting_children(second, child_box(first, child)) & others;
    if (a == b) meeting &= (0xffffU ^ (stretched >> child & 1) * 3) << child;
    write_sixteen(found.first + count, children * a + child);
    count += Target::append_bits(found.second + count, children * b, meeting);
  }
  return count;
}

/// Tells which pairs of beads are far enough apart in their necklace. Bit 4 i + j of beads[4 g + h] stands
/// for bead i of group g and bead j of group h. Bit 4 g + h of `groups` is set if these groups have such a
/// pair. The table `lanes_apart` is indexed by the least difference of the beads' indices within their
/// blocks.
struct LanesApart {
  std::array<std::uint16_t, 16> beads{};
  std::uint16_t groups = 0;
};
inline constexpr int least_all = -15, least_none = 16;
inline constexpr auto lanes_apart = [] {
  std::array<LanesApart, least_none - least_all + 1> table{};
  for (int least = least_all; least <= least_none; ++least) {
    LanesApart& lanes = table[static_cast<std::size_t>(least - least_all)];
    for (int first = 0; first < 16; ++first) {
      for (int second = 0; second < 16; ++second) {
        if (second - first < least) continue;
        const int group = 4 * (first / 4) + second / 4, bead = 4 * (first % 4) + second % 4;
        lanes.groups = static_cast<std::uint16_t>(lanes.groups | 1 << group);
        auto& beads = lanes.beads[static_cast<std::size_t>(group)];
        beads = static_cast<std::uint16_t>(beads | 1 << bead);
      }
    }
  }
  return table;
}();

/// Masks of the group pairs that compare_along leaves to `compare`, for blocks 0, 1, and at least 2 apart.
inline constexpr std::array<std::uint16_t, 3> groups_not_along{0xffff & ~0x8c63, 0xffff & ~0x1000, 0xffff};

/// Masks of the beads of a block whose partner, k beads further on, lies in their own group or the next one.
inline constexpr std::array<std::uint16_t, farthest_along + 1> firsts_along{0xffff, 0xffff, 0xffff, 0xffff,
                                                                            0xffff, 0x7777, 0x3333, 0x1111};

// If a scene exceeds the cache, each block is far from the one before in memory. Each block is therefore
// prefetched while others are compared.
inline constexpr std::size_t fetched_ahead = 8;

template <int Dimension>
KDS_BLOCK_INLINE void fetch_boxes(const Blocks<Dimension>& blocks, std::uint32_t block) {
  const char* const boxes = reinterpret_cast<const char*>(blocks.boxes + block);
  __builtin_prefetch(boxes);
  __builtin_prefetch(boxes + 64);
}
template <bool Equal, int Dimension>
KDS_BLOCK_INLINE void fetch_beads(const Blocks<Dimension>& blocks, std::uint32_t first) {
  for (const float* const axis : blocks.centers) __builtin_prefetch(axis + first);
  if constexpr (!Equal) __builtin_prefetch(blocks.radii + first);
}

struct ComparedPair {
  std::uint32_t first, second;  // numbers of the first beads of the two blocks
  const LanesApart* lanes;
};

template <class Target, int Dimension, bool Equal>
[[KDS_BLOCK_TARGET, gnu::noinline]] std::size_t compare(const Blocks<Dimension>& blocks,
                                                        const NodePairs& pairs, std::size_t count,
                                                        const LanesAsked& asked, float limit,
                                                        std::uint32_t* groups, const NearGroups& found,
                                                        std::uint64_t& tests) {
  const Blocks<Dimension> here = blocks;
  const std::uint32_t* const necklaces = asked.necklace_of_block;
  const std::uint32_t* const firsts = pairs.first;
  const std::uint32_t* const seconds = pairs.second;
  const std::int64_t within = asked.within ? std::int64_t{asked.apart} : std::int64_t{1} << 40;
  const std::int64_t between = asked.between ? least_all : least_none;
  const std::uint32_t never_along = asked.along_done ? 0 : 2;
  // Branch prediction fails on which groups meet and which beads are near. The only branch skips pairs of
  // blocks without meeting groups, which are common along a stretched chain.
  std::array<ComparedPair, block_pairs_at_once> compared;
  std::size_t meeting = 0;
  for (std::size_t p = 0; p < count;) {
    const std::uint32_t a = firsts[p];
    const std::uint32_t necklace = necklaces[a];
    const auto ours = Target::spread_groups(here.boxes[a]);
    do {
      fetch_boxes(here, seconds[std::min(p + fetched_ahead, count - 1)]);
      const std::uint32_t b = seconds[p];
      const std::int64_t along = within - 16 * (std::int64_t{b} - std::int64_t{a});
      const bool same = necklaces[b] == necklace;
      std::int64_t least = same ? along : between;
      least = std::max<std::int64_t>(least, least_all);
      least = std::min<std::int64_t>(least, least_none);
      const LanesApart* const lanes = lanes_apart.data() + (least - least_all);
      const std::uint32_t blocks_apart = std::min((same ? b - a : 2) | never_along, 2U);
      compared[p] = {16 * a, 16 * b, lanes};
      const unsigned near =
          Target::meeting_groups(ours, here.boxes[b]) & lanes->groups & groups_not_along[blocks_apart];
      if (near != 0)
        meeting += Target::append_bits(groups + meeting, static_cast<std::uint32_t>(16 * p), near);
      ++p;
    } while (p < count && firsts[p] == a);
  }
  tests += meeting;
  std::uint32_t* const near_groups = found.groups;
  std::uint16_t* const near_bits = found.beads;
  std::size_t near = 0;
  for (std::size_t k = 0; k < meeting; ++k) {
    const std::uint32_t group = groups[k];
    const ComparedPair& pair = compared[group / 16];
    fetch_beads<Equal>(here, compared[groups[std::min(k + fetched_ahead, meeting - 1)] / 16].second);
    const unsigned bits =
        Target::template near_beads<Equal>(here, std::size_t{pair.first} + (group & 12),
                                           std::size_t{pair.second} + 4 * (group & 3), limit) &
        pair.lanes->beads[group % 16];
    near_groups[near] = group;
    near_bits[near] = static_cast<std::uint16_t>(bits);
    near += bits != 0 ? 1 : 0;
  }
  return near;
}

template <class Target, int Dimension, bool Equal>
[[KDS_BLOCK_TARGET, gnu::noinline]] std::size_t compare_along(const Blocks<Dimension>& blocks,
                                                              std::size_t first, std::size_t last,
                                                              const std::uint16_t* stretched,
                                                              std::uint32_t apart, float limit,
                                                              const NearGroups& found) {
  const Blocks<Dimension> here = blocks;
  std::size_t near = 0;
  for (std::size_t b = first; b < last; ++b) {
    if ((stretched[b / children_of_node] >> b % children_of_node & 1) != 0) continue;
    std::array<unsigned, farthest_along + 1> bits;
    unsigned any = 0;
    for (std::uint32_t k = apart; k <= farthest_along; ++k) {
      bits[k] = Target::template near_along<Equal>(here, beads_in_block * b, k, limit) & firsts_along[k];
      any |= bits[k];
    }
    if (any == 0) continue;
    for (std::uint32_t k = apart; k <= farthest_along; ++k) {
      if (bits[k] == 0) continue;
      found.groups[near] = static_cast<std::uint32_t>(8 * b + k);
      found.beads[near++] = static_cast<std::uint16_t>(bits[k]);
    }
  }
  return near;
}

template <class Target, int Dimension>
inline constexpr BlockLoops<Dimension> loops_of{fill<Dimension, true>,
                                                fill<Dimension, false>,
                                                stray<Dimension>,
                                                unite<Dimension>,
                                                stretch<Target, Dimension>,
                                                expand<Target, Dimension>,
                                                compare<Target, Dimension, true>,
                                                compare<Target, Dimension, false>,
                                                compare_along<Target, Dimension, true>,
                                                compare_along<Target, Dimension, false>};

}  // namespace

}  // namespace kds
