#include "structures/contacts/block_beads.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "motions/numbers/float_lanes.h"

namespace kds {

namespace {

constexpr std::size_t row = BeadBlock::most_beads;

// A block in floats: rows of sixteen, one for each coordinate of each control point, two for radii made
// larger and smaller, one for each coordinate of the swept balls' centres, one for their radii; the sides of
// the boxes around four swept balls each, for all pairs of one of these with one of another block: each of
// the four four times, and all four four times; then the box around all.
template <int Dimension>
struct Layout {
  static constexpr std::size_t axes = static_cast<std::size_t>(Dimension);

  static constexpr std::size_t coordinates(std::size_t k, std::size_t axis) {
    return row * (k * axes + axis);
  }
  static constexpr std::size_t larger(std::size_t controls) { return row * controls * axes; }
  static constexpr std::size_t smaller(std::size_t controls) { return larger(controls) + row; }
  static constexpr std::size_t center(std::size_t controls, std::size_t axis) {
    return smaller(controls) + row * (1 + axis);
  }
  static constexpr std::size_t reach(std::size_t controls) { return center(controls, axes); }
  static constexpr std::size_t quarters(std::size_t controls, std::size_t axis) {
    return reach(controls) + row * (1 + 4 * axis);
  }
  static constexpr std::size_t box(std::size_t controls, std::size_t axis) {
    return quarters(controls, axes) + 2 * axis;
  }
  static constexpr std::size_t size(std::size_t controls) { return quarters(controls, axes) + row; }
};

struct RowBits {
  std::uint32_t apart = 0, inside = 0;
};

template <class F>
[[gnu::always_inline]] inline F load(const float* numbers) {
  typename F::Vector v;
  __builtin_memcpy(&v, numbers, sizeof v);
  return v;
}

template <class F>
[[gnu::always_inline]] inline void store(const F& lanes, float* numbers) {
  __builtin_memcpy(numbers, &lanes.v, sizeof lanes.v);
}
/// Bits of a row, gathered vector by vector.
template <class F>
class BitsOf {
 public:
  [[gnu::always_inline]] BitsOf() {
    for (std::size_t lane = 0; lane < F::width; ++lane) weight_[lane] = 1 << lane;
  }
  [[gnu::always_inline]] void add(const typename F::Mask& mask, std::size_t first) {
    bits_ |= mask & (weight_ << static_cast<int>(first));
  }
  [[nodiscard, gnu::always_inline]] std::uint32_t bits() const {
    std::array<std::uint64_t, F::width / 2> words;
    __builtin_memcpy(words.data(), &bits_, sizeof bits_);
    std::uint64_t all = 0;
    for (const std::uint64_t word : words) all |= word;
    return static_cast<std::uint32_t>(all | (all >> 32U)) & 0xffffU;
  }

 private:
  typename F::Mask bits_{}, weight_{};
};

/// `Controls`: of a curve, or 0 for as many as there are.
template <class F, int Dimension, std::size_t Controls>
struct Scan {
  using L = Layout<Dimension>;
  std::size_t given;

  [[nodiscard, gnu::always_inline]] std::size_t controls() const { return Controls == 0 ? given : Controls; }

  /// Which beads' swept balls may meet the box of another block.
  [[nodiscard, gnu::always_inline]] std::uint32_t near_box(const float* beads, const float* other) const {
    BitsOf<F> near;
    const float* const sides = other + L::box(controls(), 0);
    for (std::size_t first = 0; first < row; first += F::width) {
      const F reach = load<F>(beads + L::reach(controls()) + first);
      typename F::Mask apart{};
      for (std::size_t axis = 0; axis < L::axes; ++axis) {
        const F x = load<F>(beads + L::center(controls(), axis) + first);
        apart |= (x - reach > F(sides[2 * axis + 1])) | (F(sides[2 * axis]) > x + reach);
      }
      near.add(~apart, first);
    }
    return near.bits();
  }

  /// Which of four runs of a block may meet which of another: bit 4 a + b.
  [[nodiscard, gnu::always_inline]] std::uint32_t near_quarters(const float* a, const float* b) const {
    BitsOf<F> near;
    for (std::size_t first = 0; first < row; first += F::width) {
      typename F::Mask apart{};
      for (std::size_t axis = 0; axis < L::axes; ++axis) {
        const float* const of_a = a + L::quarters(controls(), axis) + first;
        const float* const of_b = b + L::quarters(controls(), axis) + first + 2 * row;
        apart |= (load<F>(of_a) > load<F>(of_b + row)) | (load<F>(of_b) > load<F>(of_a + row));
      }
      near.add(~apart, first);
    }
    return near.bits();
  }

  /// Which swept balls of a block may meet that of one bead of another.
  [[nodiscard, gnu::always_inline]] std::uint32_t near_bead(const float* a, std::size_t bead,
                                                            const float* b) const {
    BitsOf<F> near;
    const F reach_a(a[L::reach(controls()) + bead]);
    for (std::size_t first = 0; first < row; first += F::width) {
      F distance(0.0F);
      for (std::size_t axis = 0; axis < L::axes; ++axis) {
        const F d =
            load<F>(b + L::center(controls(), axis) + first) - F(a[L::center(controls(), axis) + bead]);
        distance += d * d;
      }
      const F reach = reach_a + load<F>(b + L::reach(controls()) + first);
      near.add(~(distance > reach * reach), first);
    }
    return near.bits();
  }

  /// One bead of a block against all of another.
  [[nodiscard, gnu::always_inline]] RowBits one_row(const float* a, std::size_t bead, const float* b) const {
    BitsOf<F> apart, inside;
    const F larger_a(a[L::larger(controls()) + bead]), smaller_a(a[L::smaller(controls()) + bead]);
    const std::size_t last = controls() - 1;
    for (std::size_t first = 0; first < row; first += F::width) {
      const auto difference = [&](std::size_t k, std::size_t axis) __attribute__((always_inline)) {
        return load<F>(b + L::coordinates(k, axis) + first) - F(a[L::coordinates(k, axis) + bead]);
      };
      std::array<F, L::axes> n;
      F length(0.0F);
      for (std::size_t axis = 0; axis < L::axes; ++axis) {
        n[axis] = difference(0, axis) + difference(last, axis);
        length += n[axis] * n[axis];
      }
      const F larger = larger_a + load<F>(b + L::larger(controls()) + first);
      const F smaller = smaller_a + load<F>(b + L::smaller(controls()) + first);
      const F reach = larger * larger * length, within = smaller * smaller;
      typename F::Mask all_apart = ~typename F::Mask{}, all_inside = smaller > F(0.0F);
      for (std::size_t k = 0; k <= last; ++k) {
        F along(0.0F), square(0.0F);
        for (std::size_t axis = 0; axis < L::axes; ++axis) {
          const F d = difference(k, axis);
          along += n[axis] * d;
          square += d * d;
        }
        all_apart &= (along > F(0x1p-40F)) & (along * along > reach);
        all_inside &= within > square;
      }
      apart.add(all_apart, first);
      inside.add(all_inside, first);
    }
    return {apart.bits(), inside.bits()};
  }
};

/// A bead of one block and, one bit each, beads of another.
struct RowFound {
  std::uint32_t bead;    // of all
  std::uint32_t others;  // block
  std::uint32_t inside, unclear;
};

/// A look at a few pairs of blocks at a time. Each stage sifts what the one before left over, and lists what
/// it leaves without a branch: no one foretells what that will be.
struct Look {
  static constexpr std::size_t at_a_time = 64;
  struct PairLeft {
    BlockPair blocks;
    std::uint32_t quarters;  // bit 4 a + b: run a of the first may meet run b of the second
  };
  struct RowLeft {
    BlockPair blocks;
    std::uint32_t bead;  // of the first block
    std::uint32_t near;
  };

  const float* floats;
  std::size_t stride, controls;
  const BeadBlock* blocks;
  BeadId apart;

  std::uint64_t looked_at = 0;
  std::size_t pairs_left, rows_left, count;
  std::array<PairLeft, at_a_time> pairs;
  std::array<RowLeft, at_a_time * row> rows;
  std::array<RowFound, at_a_time * row> found;

  [[nodiscard, gnu::always_inline]] const float* block(std::uint32_t place) const {
    return floats + place * stride;
  }
};

/// Beads of a block that a bead is asked about by their distance along the chain, at least `apart`; the block
/// begins `offset` beads after the bead's own, or is its own: then those that follow.
[[gnu::always_inline]] inline std::uint32_t far_enough(std::size_t bead, std::int64_t offset, BeadId apart) {
  constexpr std::uint32_t all = (1U << row) - 1U;
  const std::int64_t from = static_cast<std::int64_t>(bead) + static_cast<std::int64_t>(apart) - offset;
  return from <= 0 ? all : from >= static_cast<std::int64_t>(row) ? 0U : (all << from) & all;
}

[[nodiscard, gnu::always_inline]] inline std::int64_t chain_offset(const BeadBlock& a, const BeadBlock& b) {
  if (a.necklace != b.necklace) return std::numeric_limits<std::int64_t>::max() / 2;
  return static_cast<std::int64_t>(b.first) - static_cast<std::int64_t>(a.first);
}

/// Four bits, each four times.
[[gnu::always_inline]] inline std::uint32_t each_four_times(std::uint32_t bits) {
  const std::uint32_t spread = (bits & 1U) | (bits & 2U) << 3U | (bits & 4U) << 6U | (bits & 8U) << 9U;
  return spread * 0xfU;
}

template <class F, int Dimension, std::size_t Controls>
[[gnu::always_inline]] inline void look_at_pairs(std::span<const BlockPair> pairs, Look& look) {
  const Scan<F, Dimension, Controls> scan{look.controls};
  look.pairs_left = look.rows_left = look.count = 0;
  for (const BlockPair& pair : pairs) {
    const std::uint32_t quarters = scan.near_quarters(look.block(pair.first), look.block(pair.second));
    look.pairs[look.pairs_left] = {pair, quarters};
    look.pairs_left += quarters != 0 ? 1 : 0;
  }
  for (std::size_t p = 0; p < look.pairs_left; ++p) {
    const auto [pair, quarters] = look.pairs[p];
    const float *const a = look.block(pair.first), *const b = look.block(pair.second);
    std::uint32_t rows = look.blocks[pair.first].bits(), columns = look.blocks[pair.second].bits();
    if (pair.first != pair.second) {
      rows &= scan.near_box(a, b);
      columns &= scan.near_box(b, a);
    }
    const std::int64_t offset = chain_offset(look.blocks[pair.first], look.blocks[pair.second]);
    for (; rows != 0; rows &= rows - 1) {
      const auto bead = static_cast<std::uint32_t>(std::countr_zero(rows));
      const std::uint32_t asked =
          columns & each_four_times(quarters >> (bead & 12U) & 15U) & far_enough(bead, offset, look.apart);
      if (asked == 0) continue;
      const std::uint32_t near = asked & scan.near_bead(a, bead, b);
      look.looked_at += static_cast<std::uint64_t>(std::popcount(asked));
      look.rows[look.rows_left] = {pair, bead, near};
      look.rows_left += near != 0 ? 1 : 0;
    }
  }
  for (std::size_t r = 0; r < look.rows_left; ++r) {
    const auto& [pair, bead, near] = look.rows[r];
    const RowBits bits = scan.one_row(look.block(pair.first), bead, look.block(pair.second));
    const std::uint32_t left = near & ~bits.apart;
    look.found[look.count] = {look.blocks[pair.first].first + bead, pair.second, left & bits.inside,
                              left & ~bits.inside};
    look.count += left != 0 ? 1 : 0;
  }
}

template <class F, int Dimension>
[[gnu::always_inline]] inline void look_at_pairs(std::span<const BlockPair> pairs, Look& look) {
  if (look.controls == 2) {
    look_at_pairs<F, Dimension, 2>(pairs, look);
  } else {
    look_at_pairs<F, Dimension, 0>(pairs, look);
  }
}

template <int Dimension>
[[KDS_FLOAT_LANES_TARGETS]] void look_in_eights(std::span<const BlockPair> pairs, Look& look) {
  look_at_pairs<FloatLanesIn<8>, Dimension>(pairs, look);
}
template <int Dimension>
[[KDS_FLOAT_LANES_TARGETS]] void look_in_fours(std::span<const BlockPair> pairs, Look& look) {
  look_at_pairs<FloatLanesIn<4>, Dimension>(pairs, look);
}

/// Calls visit(bead) for each bit.
template <class Visit>
void for_each_bead(const BeadBlock& block, std::uint32_t bits, const Visit& visit) {
  for (; bits != 0; bits &= bits - 1) visit(block.first + static_cast<BeadId>(std::countr_zero(bits)));
}

/// What a block's floats are made of.
template <int Dimension>
struct Move {
  const Curves<Dimension>* curves;
  std::span<const BeadBlock> blocks;
  const double* middle;
  const float* drift;
  double scale;
  std::size_t controls;
};

/// A bead of a block; where there are fewer its last one stands for those that lack.
[[nodiscard, gnu::always_inline]] inline BeadId bead_at(const BeadBlock& block, std::size_t place) {
  return block.first + std::min(static_cast<BeadId>(place), static_cast<BeadId>(block.count - 1));
}

/// The coordinates of a block.
template <int Dimension>
[[gnu::always_inline]] inline void convert(const Move<Dimension>& move, const BeadBlock& beads,
                                           float* numbers) {
  using L = Layout<Dimension>;
  using F = FloatLanesIn<4>;
  const Lanes scale(move.scale);
  Lanes middle(0.0);
  for (std::size_t axis = 0; axis < L::axes; ++axis) middle.v[axis] = move.middle[axis];
  for (std::size_t first = 0; first < row; first += F::width) {
    for (std::size_t k = 0; k < move.controls; ++k) {
      std::array<typename F::Row, F::width> rows;
      for (std::size_t i = 0; i < F::width; ++i) {
        const double* const p = move.curves->control_point(bead_at(beads, first + i), static_cast<int>(k));
        Lanes point;
        if constexpr (Dimension == 3) {
          point = Lanes::load(p);
        } else {
          point = Lanes::Vector{p[0], p[1], 0, 0};
        }
        rows[i] = F::rounded((scale * (point - middle)).v);
      }
      const std::array<F, 4> columns = F::transposed(rows);
      for (std::size_t axis = 0; axis < L::axes; ++axis)
        store(columns[axis], numbers + L::coordinates(k, axis) + first);
    }
  }
}

/// The boxes around swept balls, along one axis.
template <int Dimension>
[[gnu::always_inline]] inline void bound(const std::array<float, row>& low,
                                         const std::array<float, row>& high, std::size_t axis,
                                         std::size_t controls, float* numbers) {
  using L = Layout<Dimension>;
  std::array<float, 4> lowest, highest;
  for (std::size_t q = 0; q < 4; ++q) {
    const std::size_t i = 4 * q;
    lowest[q] = std::min(std::min(low[i], low[i + 1]), std::min(low[i + 2], low[i + 3]));
    highest[q] = std::max(std::max(high[i], high[i + 1]), std::max(high[i + 2], high[i + 3]));
  }
  float* const sides = numbers + L::quarters(controls, axis);
  for (std::size_t q = 0; q < 4; ++q) {
    for (std::size_t i = 0; i < 4; ++i) {
      sides[4 * q + i] = lowest[q];
      sides[row + 4 * q + i] = highest[q];
      sides[2 * row + 4 * q + i] = lowest[i];
      sides[3 * row + 4 * q + i] = highest[i];
    }
  }
  numbers[L::box(controls, axis)] = std::min(std::min(lowest[0], lowest[1]), std::min(lowest[2], lowest[3]));
  numbers[L::box(controls, axis) + 1] =
      std::max(std::max(highest[0], highest[1]), std::max(highest[2], highest[3]));
}

/// The swept balls of a block, and the boxes around them.
template <class F, int Dimension>
[[gnu::always_inline]] inline void sweep(const Move<Dimension>& move, float* numbers) {
  using L = Layout<Dimension>;
  const std::size_t controls = move.controls, last = controls - 1;
  std::array<std::array<float, row>, L::axes> low, high;
  for (std::size_t first = 0; first < row; first += F::width) {
    std::array<F, L::axes> center;
    for (std::size_t axis = 0; axis < L::axes; ++axis) {
      const F from = load<F>(numbers + L::coordinates(0, axis) + first);
      const F to = load<F>(numbers + L::coordinates(last, axis) + first);
      center[axis] = F(0.5F) * (from + (to - F(move.drift[last * L::axes + axis])));
      store(center[axis], numbers + L::center(controls, axis) + first);
    }
    F square(0.0F);
    for (std::size_t k = 0; k < controls; ++k) {
      F strayed(0.0F);
      for (std::size_t axis = 0; axis < L::axes; ++axis) {
        const F x = load<F>(numbers + L::coordinates(k, axis) + first);
        const F d = (x - F(move.drift[k * L::axes + axis])) - center[axis];
        strayed += d * d;
      }
      square = F::max(square, strayed);
    }
    for (std::size_t lane = 0; lane < F::width; ++lane) square.v[lane] = std::sqrt(square.v[lane]);
    const F larger = load<F>(numbers + L::larger(controls) + first);
    const F reach = (larger + square + F(0x1p-20F)) * F(1 + 0x1p-20F);
    store(reach, numbers + L::reach(controls) + first);
    for (std::size_t axis = 0; axis < L::axes; ++axis) {
      store(center[axis] - reach, low[axis].data() + first);
      store(center[axis] + reach, high[axis].data() + first);
    }
  }
  for (std::size_t axis = 0; axis < L::axes; ++axis)
    bound<Dimension>(low[axis], high[axis], axis, controls, numbers);
}

template <class F, int Dimension>
[[gnu::always_inline]] inline void move_blocks(const Move<Dimension>& move, std::size_t stride,
                                               float* floats) {
  for (std::size_t block = 0; block < move.blocks.size(); ++block, floats += stride) {
    convert(move, move.blocks[block], floats);
    sweep<F>(move, floats);
  }
}
template <int Dimension>
[[KDS_FLOAT_LANES_TARGETS]] void move_in_eights(const Move<Dimension>& move, std::size_t stride,
                                                float* floats) {
  move_blocks<FloatLanesIn<8>>(move, stride, floats);
}
template <int Dimension>
[[KDS_FLOAT_LANES_TARGETS]] void move_in_fours(const Move<Dimension>& move, std::size_t stride,
                                               float* floats) {
  move_blocks<FloatLanesIn<4>>(move, stride, floats);
}

bool has_long_vectors() {
#if defined(__x86_64__)
  return __builtin_cpu_supports("avx2") != 0;
#else
  return false;
#endif
}

}  // namespace

template <int Dimension>
BlockBeads<Dimension>::BlockBeads(std::span<const BeadBlock> blocks, int degree)
    : blocks_(blocks),
      controls_(static_cast<std::size_t>(degree) + 1),
      stride_(Layout<Dimension>::size(controls_)),
      floats_(stride_ * blocks.size()),
      long_vectors_(has_long_vectors()) {}

template <int Dimension>
void BlockBeads<Dimension>::move_to(const Curves<Dimension>& curves,
                                    const std::array<double, Dimension>& middle, double half) {
  int exponent = 0;
  usable_ = std::isfinite(half) && half > 0;
  if (usable_) (void)std::frexp(half, &exponent);
  usable_ = usable_ && std::abs(exponent) < 1000;
  if (!usable_) return;
  const double scale = std::ldexp(1.0, -exponent);
  find_drift(curves, scale);
  set_radii(curves, scale);
  const Move<Dimension> move{&curves, blocks_, middle.data(), drift_.data(), scale, controls_};
  if (long_vectors_) {
    move_in_eights(move, stride_, floats_.data());
  } else {
    move_in_fours(move, stride_, floats_.data());
  }
}

// What a sample of beads moves on average, control point by control point. Any numbers would do.
template <int Dimension>
void BlockBeads<Dimension>::find_drift(const Curves<Dimension>& curves, double scale) {
  constexpr std::size_t axes = Layout<Dimension>::axes;
  drift_.assign(controls_ * axes, 0.0F);
  const std::size_t step = 1 + blocks_.size() / 64;
  for (std::size_t k = 1; k < controls_; ++k) {
    for (std::size_t axis = 0; axis < axes; ++axis) {
      double sum = 0, count = 0;
      for (std::size_t block = 0; block < blocks_.size(); block += step) {
        const BeadId bead = blocks_[block].first;
        sum += scale *
               (curves.control_point(bead, static_cast<int>(k))[axis] - curves.control_point(bead, 0)[axis]);
        count += 1;
      }
      drift_[k * axes + axis] = static_cast<float>(sum / count);
    }
  }
}

// Only where they are not those of the step before.
template <int Dimension>
void BlockBeads<Dimension>::set_radii(const Curves<Dimension>& curves, double scale) {
  using L = Layout<Dimension>;
  constexpr double spare = 0x1p-19;
  const std::size_t beads = curves.bead_count();
  bool same = scale == scale_of_radii_ && radii_.size() == beads * controls_;
  radii_.resize(beads * controls_);
  for (BeadId bead = 0; bead < beads; ++bead) {
    for (std::size_t k = 0; k < controls_; ++k) {
      double& known = radii_[bead * controls_ + k];
      const double radius = curves.radii(bead)[k];
      same &= known == radius;
      known = radius;
    }
  }
  if (same) return;
  scale_of_radii_ = scale;
  for (std::size_t block = 0; block < blocks_.size(); ++block) {
    float* const numbers = &floats_[block * stride_];
    for (std::size_t i = 0; i < row; ++i) {
      const double* const radii = &radii_[bead_at(blocks_[block], i) * controls_];
      const auto [least, most] = std::minmax_element(radii, radii + controls_);
      numbers[L::larger(controls_) + i] = static_cast<float>(scale * *most * (1 + 0x1p-20) + spare);
      numbers[L::smaller(controls_) + i] = static_cast<float>(scale * *least * (1 - 0x1p-20) - spare);
    }
  }
}

template <int Dimension>
void BlockBeads<Dimension>::look_at(std::span<const BlockPair> blocks, BeadId apart, bool list_overlapping,
                                    PairsOfBlocks& pairs) const {
  if (!usable_) {
    for (const BlockPair& pair : blocks) look_at_all(blocks_[pair.first], blocks_[pair.second], apart, pairs);
    return;
  }
  Look look;
  look.floats = floats_.data();
  look.stride = stride_;
  look.controls = controls_;
  look.blocks = blocks_.data();
  look.apart = apart;
  for (; !blocks.empty(); blocks = blocks.subspan(std::min(Look::at_a_time, blocks.size()))) {
    const auto some = blocks.first(std::min(Look::at_a_time, blocks.size()));
    if (long_vectors_) {
      look_in_eights<Dimension>(some, look);
    } else {
      look_in_fours<Dimension>(some, look);
    }
    for (std::size_t r = 0; r < look.count; ++r) {
      const RowFound& of = look.found[r];
      const BeadBlock& others = blocks_[of.others];
      for_each_bead(others, of.unclear, [&](BeadId other) { pairs.unclear.push_back({of.bead, other}); });
      if (list_overlapping)
        for_each_bead(others, of.inside, [&](BeadId other) {
          pairs.overlapping.push_back({of.bead, other});
        });
    }
  }
  pairs.looked_at += look.looked_at;
}

template <int Dimension>
void BlockBeads<Dimension>::look_at_all(const BeadBlock& a, const BeadBlock& b, BeadId apart,
                                        PairsOfBlocks& pairs) const {
  const std::int64_t offset = chain_offset(a, b);
  for (std::size_t i = 0; i < a.count; ++i) {
    const std::uint32_t asked = b.bits() & far_enough(i, offset, apart);
    pairs.looked_at += static_cast<std::uint64_t>(std::popcount(asked));
    const BeadId bead = a.first + static_cast<BeadId>(i);
    for_each_bead(b, asked, [&](BeadId other) { pairs.unclear.push_back({bead, other}); });
  }
}

template class BlockBeads<2>;
template class BlockBeads<3>;

}  // namespace kds
