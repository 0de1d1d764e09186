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
// larger and smaller, one for each coordinate of the swept balls' centres, one for their radii; then the box
// around the swept balls.
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
  static constexpr std::size_t box(std::size_t controls, std::size_t axis) {
    return reach(controls) + row + 2 * axis;
  }
  static constexpr std::size_t size(std::size_t controls) { return reach(controls) + 2 * row; }
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

/// What it finds out about a bead of the first of two blocks: one bit a bead of the second.
struct RowFound {
  std::uint32_t bead;
  std::uint32_t second;  // block
  std::uint32_t inside, unclear;
};

/// A look at many pairs of blocks, which stops where there is no room for what it finds.
struct Look {
  const float* floats;
  std::size_t stride, controls;
  const BeadBlock* blocks;
  std::span<const BlockPair> pairs;
  BeadId apart;

  std::size_t next = 0;  // pair
  std::uint64_t looked_at = 0;
  std::size_t count = 0;
  std::array<RowFound, 32 * row> found;
};

/// Beads of the second block that a bead of the first is asked about, by their distance along the chain. They
/// are far enough where blocks are of two necklaces: `chain_offset` says how far their first beads are.
[[gnu::always_inline]] inline std::uint32_t far_enough(std::size_t bead, std::int64_t chain_offset,
                                                       BeadId apart) {
  const std::int64_t from = static_cast<std::int64_t>(bead) + static_cast<std::int64_t>(apart) - chain_offset;
  if (from <= 0) return 0xffffU;
  return from >= static_cast<std::int64_t>(row) ? 0U : (0xffffU << from) & 0xffffU;
}

[[nodiscard, gnu::always_inline]] inline std::int64_t chain_offset(const BeadBlock& a, const BeadBlock& b) {
  if (a.necklace != b.necklace) return std::numeric_limits<std::int64_t>::max() / 2;
  return static_cast<std::int64_t>(b.first) - static_cast<std::int64_t>(a.first);
}

template <class F, int Dimension, std::size_t Controls>
[[gnu::always_inline]] inline void look_at_two(const BlockPair& pair, Look& look) {
  const Scan<F, Dimension, Controls> scan{look.controls};
  const BeadBlock &first = look.blocks[pair.first], &second = look.blocks[pair.second];
  const float* const a = look.floats + pair.first * look.stride;
  const float* const b = look.floats + pair.second * look.stride;
  std::uint32_t rows = first.bits(), columns = second.bits();
  if (a != b) {
    rows &= scan.near_box(a, b);
    if (rows == 0) return;
    columns &= scan.near_box(b, a);
    if (columns == 0) return;
  }
  const std::int64_t offset = chain_offset(first, second);
  for (; rows != 0; rows &= rows - 1) {
    const auto bead = static_cast<std::uint32_t>(std::countr_zero(rows));
    const std::uint32_t asked = columns & far_enough(bead, offset, look.apart);
    if (asked == 0) continue;
    look.looked_at += static_cast<std::uint64_t>(std::popcount(asked));
    const std::uint32_t near = asked & scan.near_bead(a, bead, b);
    if (near == 0) continue;
    const RowBits bits = scan.one_row(a, bead, b);
    const std::uint32_t left = near & ~bits.apart;
    if (left != 0)
      look.found[look.count++] = {first.first + bead, pair.second, left & bits.inside, left & ~bits.inside};
  }
}

template <class F, int Dimension, std::size_t Controls>
[[gnu::always_inline]] inline void look_at_pairs(Look& look) {
  for (; look.next < look.pairs.size() && look.count + row <= look.found.size(); ++look.next)
    look_at_two<F, Dimension, Controls>(look.pairs[look.next], look);
}

template <class F, int Dimension>
[[gnu::always_inline]] inline void look_at_pairs(Look& look) {
  if (look.controls == 2) {
    look_at_pairs<F, Dimension, 2>(look);
  } else {
    look_at_pairs<F, Dimension, 0>(look);
  }
}

template <int Dimension>
[[KDS_FLOAT_LANES_TARGETS]] void look_in_eights(Look& look) {
  look_at_pairs<FloatLanesIn<8>, Dimension>(look);
}
template <int Dimension>
[[KDS_FLOAT_LANES_TARGETS]] void look_in_fours(Look& look) {
  look_at_pairs<FloatLanesIn<4>, Dimension>(look);
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

/// Of a block; where it has fewer beads its last one stands for those that lack.
template <int Dimension>
[[gnu::always_inline]] inline void convert(const Move<Dimension>& move, const BeadBlock& beads,
                                           float* numbers) {
  using L = Layout<Dimension>;
  using F = FloatLanesIn<4>;
  constexpr double spare = 0x1p-19;
  const Lanes scale(move.scale);
  Lanes middle(0.0);
  for (std::size_t axis = 0; axis < L::axes; ++axis) middle.v[axis] = move.middle[axis];
  for (std::size_t first = 0; first < row; first += F::width) {
    std::array<BeadId, F::width> some;
    for (std::size_t i = 0; i < F::width; ++i)
      some[i] = beads.first + std::min(static_cast<BeadId>(first + i), static_cast<BeadId>(beads.count - 1));
    for (std::size_t i = 0; i < F::width; ++i) {
      const double* const radii = move.curves->radii(some[i]);
      double least = radii[0], most = radii[0];
      for (std::size_t k = 1; k < move.controls; ++k) {
        least = std::min(least, radii[k]);
        most = std::max(most, radii[k]);
      }
      numbers[L::larger(move.controls) + first + i] =
          static_cast<float>(move.scale * most * (1 + 0x1p-20) + spare);
      numbers[L::smaller(move.controls) + first + i] =
          static_cast<float>(move.scale * least * (1 - 0x1p-20) - spare);
    }
    for (std::size_t k = 0; k < move.controls; ++k) {
      std::array<typename F::Row, F::width> rows;
      for (std::size_t i = 0; i < F::width; ++i) {
        const double* const p = move.curves->control_point(some[i], static_cast<int>(k));
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
        __builtin_memcpy(numbers + L::coordinates(k, axis) + first, &columns[axis].v, sizeof columns[axis].v);
    }
  }
}

/// The swept balls, and the box around them.
template <int Dimension>
[[gnu::always_inline]] inline void sweep(const Move<Dimension>& move, float* numbers) {
  using L = Layout<Dimension>;
  const std::size_t controls = move.controls, last = controls - 1;
  std::array<float, row> square{};
  for (std::size_t axis = 0; axis < L::axes; ++axis) {
    float* const center = numbers + L::center(controls, axis);
    const float* const from = numbers + L::coordinates(0, axis);
    const float* const to = numbers + L::coordinates(last, axis);
    const float drift = move.drift[last * L::axes + axis];
    for (std::size_t i = 0; i < row; ++i) center[i] = 0.5F * (from[i] + (to[i] - drift));
  }
  for (std::size_t k = 0; k < controls; ++k) {
    std::array<float, row> strayed{};
    for (std::size_t axis = 0; axis < L::axes; ++axis) {
      const float* const center = numbers + L::center(controls, axis);
      const float* const x = numbers + L::coordinates(k, axis);
      const float drift = move.drift[k * L::axes + axis];
      for (std::size_t i = 0; i < row; ++i) {
        const float d = (x[i] - drift) - center[i];
        strayed[i] += d * d;
      }
    }
    for (std::size_t i = 0; i < row; ++i) square[i] = std::max(square[i], strayed[i]);
  }
  float* const reach = numbers + L::reach(controls);
  const float* const larger = numbers + L::larger(controls);
  for (std::size_t i = 0; i < row; ++i)
    reach[i] = (larger[i] + std::sqrt(square[i]) + 0x1p-20F) * (1 + 0x1p-20F);
  for (std::size_t axis = 0; axis < L::axes; ++axis) {
    const float* const center = numbers + L::center(controls, axis);
    std::array<float, row> low, high;
    for (std::size_t i = 0; i < row; ++i) {
      low[i] = center[i] - reach[i];
      high[i] = center[i] + reach[i];
    }
    for (std::size_t half = row / 2; half > 0; half /= 2) {
      for (std::size_t i = 0; i < half; ++i) {
        low[i] = std::min(low[i], low[i + half]);
        high[i] = std::max(high[i], high[i + half]);
      }
    }
    numbers[L::box(controls, axis)] = low[0];
    numbers[L::box(controls, axis) + 1] = high[0];
  }
}

template <int Dimension>
[[KDS_FLOAT_LANES_TARGETS]] void move_blocks(const Move<Dimension>& move, std::size_t stride, float* floats) {
  for (std::size_t block = 0; block < move.blocks.size(); ++block, floats += stride) {
    convert(move, move.blocks[block], floats);
    sweep(move, floats);
  }
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
  move_blocks<Dimension>({&curves, blocks_, middle.data(), drift_.data(), scale, controls_}, stride_,
                         floats_.data());
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
  look.pairs = blocks;
  look.apart = apart;
  while (look.next < blocks.size()) {
    look.count = 0;
    if (long_vectors_) {
      look_in_eights<Dimension>(look);
    } else {
      look_in_fours<Dimension>(look);
    }
    for (std::size_t r = 0; r < look.count; ++r) {
      const RowFound& of = look.found[r];
      const BeadBlock& others = blocks_[of.second];
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
