#include "structures/contacts/block_beads.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "motions/numbers/float_lanes.h"
#include "motions/numbers/lanes.h"

namespace kds {

namespace {

constexpr std::size_t row = BeadBlock::most_beads;
static_assert(row == beads_in_block);

// Layout of a block in floats: one row of sixteen for each coordinate of each control point, and two rows for
// the enlarged and the reduced radii.
template <int Dimension>
struct Layout {
  static constexpr std::size_t axes = static_cast<std::size_t>(Dimension);

  static constexpr std::size_t coordinates(std::size_t k, std::size_t axis) {
    return row * (k * axes + axis);
  }
  static constexpr std::size_t larger(std::size_t controls) { return row * controls * axes; }
  static constexpr std::size_t smaller(std::size_t controls) { return larger(controls) + row; }
  static constexpr std::size_t size(std::size_t controls) { return smaller(controls) + row; }
};

struct ProvedBits {
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

/// Built from all lanes at once, which compiles to a single instruction.
template <class F>
[[gnu::always_inline]] inline F root(const F& a) {
  using Row = typename F::Row;
  const auto four = [&](std::size_t k) __attribute__((always_inline)) {
    return Row{std::sqrt(a.v[k]), std::sqrt(a.v[k + 1]), std::sqrt(a.v[k + 2]), std::sqrt(a.v[k + 3])};
  };
  if constexpr (F::width == 4) {
    return four(0);
  } else {
    return F(__builtin_shufflevector(four(0), four(4), 0, 1, 2, 3, 4, 5, 6, 7));
  }
}

// All pairs of four beads of one block and four of another are tested in parallel: lane 4 i + j holds pair
// (i, j).

/// Puts number j into the lanes of the pairs (i, j).
template <class F>
[[gnu::always_inline]] inline F four_after_four(const float* numbers) {
  const auto four = load<FloatLanesIn<4>>(numbers);
  if constexpr (F::width == 4) {
    return four;
  } else {
    return F(__builtin_shufflevector(four.v, four.v, 0, 1, 2, 3, 0, 1, 2, 3));
  }
}
/// Puts number i into the lanes of the pairs (i, j), for the vector whose first lane is pair `first`.
template <class F>
[[gnu::always_inline]] inline F each_four_times(const float* numbers, std::size_t first) {
  if constexpr (F::width == 4) {
    return F(numbers[first / 4]);
  } else {  // shuffles within each half, which is cheap
    const auto v = four_after_four<F>(numbers).v;
    return F(first == 0 ? __builtin_shufflevector(v, v, 0, 0, 0, 0, 5, 5, 5, 5)
                        : __builtin_shufflevector(v, v, 2, 2, 2, 2, 7, 7, 7, 7));
  }
}

/// Collects the bits of sixteen pairs, vector by vector.
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

/// `Controls` is the number of control points per curve; 0 means that it is known at run time only.
template <class F, int Dimension, std::size_t Controls>
struct Scan {
  using L = Layout<Dimension>;
  std::size_t given;

  [[nodiscard, gnu::always_inline]] std::size_t controls() const { return Controls == 0 ? given : Controls; }

  /// Tests four beads of a block against four of another. a and b point to their numbers in the first row of
  /// each block.
  [[nodiscard, gnu::always_inline]] ProvedBits proved(const float* a, const float* b) const {
    BitsOf<F> apart, inside;
    const std::size_t last = controls() - 1;
    for (std::size_t first = 0; first < row; first += F::width) {
      const auto difference = [&](std::size_t k, std::size_t axis) __attribute__((always_inline)) {
        const std::size_t x = L::coordinates(k, axis);
        return four_after_four<F>(b + x) - each_four_times<F>(a + x, first);
      };
      const auto sum = [&](std::size_t radii) __attribute__((always_inline)) {
        return each_four_times<F>(a + radii, first) + four_after_four<F>(b + radii);
      };
      std::array<F, L::axes> n;
      F length(0.0F);
      for (std::size_t axis = 0; axis < L::axes; ++axis) {
        n[axis] = difference(0, axis) + difference(last, axis);
        length += n[axis] * n[axis];
      }
      const F larger = sum(L::larger(controls())), smaller = sum(L::smaller(controls()));
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

/// Results for some pairs of blocks. Groups of four beads are numbered as in the block loops. Bit 4 i + j
/// stands for bead i of the first group and bead j of the second.
struct Look {
  static constexpr std::size_t most_groups = 16 * block_pairs_at_once + loop_padding;

  std::array<std::uint32_t, block_pairs_at_once> firsts, seconds;  // numbers of blocks
  std::array<std::uint32_t, most_groups> scratch, groups;
  std::array<std::uint16_t, most_groups> unclear, inside;
  std::size_t count;

  [[nodiscard, gnu::always_inline]] std::uint32_t first_block(std::size_t k) const {
    return firsts[groups[k] / 16];
  }
  [[nodiscard, gnu::always_inline]] std::uint32_t second_block(std::size_t k) const {
    return seconds[groups[k] / 16];
  }
  /// Returns the index in its block of the first of four beads.
  [[nodiscard, gnu::always_inline]] std::uint32_t first_bead(std::size_t k) const { return groups[k] & 12U; }
  [[nodiscard, gnu::always_inline]] std::uint32_t second_bead(std::size_t k) const {
    return 4 * (groups[k] & 3U);
  }
};

/// Blocks in floats, stored consecutively.
struct BlockNumbers {
  const float* floats;
  std::size_t stride, controls;
};

/// Applies the second filter to the groups whose swept balls may meet.
template <class F, int Dimension, std::size_t Controls>
[[gnu::always_inline]] inline void prove_groups(const BlockNumbers& blocks, Look& look) {
  const Scan<F, Dimension, Controls> scan{blocks.controls};
  for (std::size_t k = 0; k < look.count; ++k) {
    const ProvedBits bits =
        scan.proved(blocks.floats + blocks.stride * look.first_block(k) + look.first_bead(k),
                    blocks.floats + blocks.stride * look.second_block(k) + look.second_bead(k));
    const std::uint32_t left = look.unclear[k] & ~bits.apart;
    look.unclear[k] = static_cast<std::uint16_t>(left & ~bits.inside);
    look.inside[k] = static_cast<std::uint16_t>(left & bits.inside);
  }
}

template <class F, int Dimension>
[[gnu::always_inline]] inline void prove_groups(const BlockNumbers& blocks, Look& look) {
  if (blocks.controls == 2) {
    prove_groups<F, Dimension, 2>(blocks, look);
  } else {
    prove_groups<F, Dimension, 0>(blocks, look);
  }
}

template <int Dimension>
void prove_in_eights(const BlockNumbers& blocks, Look& look) {
  prove_groups<FloatLanesIn<8>, Dimension>(blocks, look);
}
template <int Dimension>
void prove_in_fours(const BlockNumbers& blocks, Look& look) {
  prove_groups<FloatLanesIn<4>, Dimension>(blocks, look);
}

/// Calls visit(bead, other) for each set bit 4 i + j.
template <class Visit>
void for_each_pair(BeadId first, BeadId second, std::uint32_t bits, const Visit& visit) {
  for (; bits != 0; bits &= bits - 1) {
    const auto index = static_cast<BeadId>(std::countr_zero(bits));
    visit(first + index / 4, second + index % 4);
  }
}

/// Input for the floats of a block.
template <int Dimension>
struct Move {
  const Curves<Dimension>* curves;
  std::span<const BeadBlock> blocks;
  const double* middle;
  const float* drift;
  double scale;
  std::size_t controls;
  Blocks<Dimension> swept;
};

/// Returns a bead of a block. In a block with fewer beads, the last bead stands for the missing ones.
[[nodiscard, gnu::always_inline]] inline BeadId bead_at(const BeadBlock& block, std::size_t index) {
  return block.first + std::min(static_cast<BeadId>(index), static_cast<BeadId>(block.count - 1));
}

/// Converts the coordinates of a block.
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

/// Stores the least and the greatest of each four numbers of a row.
[[gnu::always_inline]] inline void store_extremes(const std::array<float, row>& low,
                                                  const std::array<float, row>& high,
                                                  std::array<float, 4>& lowest,
                                                  std::array<float, 4>& highest) {
  using F = FloatLanesIn<4>;
  std::array<F::Row, 4> lows, highs;
  for (std::size_t i = 0; i < 4; ++i) {
    lows[i] = load<F>(low.data() + 4 * i).v;
    highs[i] = load<F>(high.data() + 4 * i).v;
  }
  const std::array<F, 4> l = F::transposed(lows), h = F::transposed(highs);
  store(-F::max(F::max(-l[0], -l[1]), F::max(-l[2], -l[3])), lowest.data());
  store(F::max(F::max(h[0], h[1]), F::max(h[2], h[3])), highest.data());
}

/// Computes the swept balls of a block and the boxes around four balls each. In a box of four, the last bead
/// stands for a missing one. On its own, a missing bead is near nothing, and so is a box without a bead.
template <class F, int Dimension>
[[gnu::always_inline]] inline void sweep(const Move<Dimension>& move, std::size_t block,
                                         const float* numbers) {
  using L = Layout<Dimension>;
  const std::size_t controls = move.controls, last = controls - 1;
  const Blocks<Dimension>& swept = move.swept;
  std::array<std::array<float, row>, L::axes> low, high;
  for (std::size_t first = 0; first < row; first += F::width) {
    std::array<F, L::axes> center;
    for (std::size_t axis = 0; axis < L::axes; ++axis) {
      const F from = load<F>(numbers + L::coordinates(0, axis) + first);
      const F to = load<F>(numbers + L::coordinates(last, axis) + first);
      center[axis] = F(0.5F) * (from + (to - F(move.drift[last * L::axes + axis])));
      store(center[axis], swept.centers[axis] + row * block + first);
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
    const F larger = load<F>(numbers + L::larger(controls) + first);
    const F reach = (larger + root(square) + F(0x1p-20F)) * F(1 + 0x1p-20F);
    store(reach, swept.radii + row * block + first);
    for (std::size_t axis = 0; axis < L::axes; ++axis) {
      store(center[axis] - reach, low[axis].data() + first);
      store(center[axis] + reach, high[axis].data() + first);
    }
  }
  GroupBoxes<Dimension>& boxes = swept.boxes[block];
  for (std::size_t axis = 0; axis < L::axes; ++axis)
    store_extremes(low[axis], high[axis], boxes.low[axis], boxes.high[axis]);
  for (std::size_t group = (move.blocks[block].count + 3) / 4; group < 4; ++group) {
    for (std::size_t axis = 0; axis < L::axes; ++axis) {
      boxes.low[axis][group] = std::numeric_limits<float>::infinity();
      boxes.high[axis][group] = -std::numeric_limits<float>::infinity();
    }
  }
  for (std::size_t i = move.blocks[block].count; i < row; ++i)
    swept.centers[0][row * block + i] = std::numeric_limits<float>::quiet_NaN();
}

template <class F, int Dimension>
[[gnu::always_inline]] inline void move_blocks(const Move<Dimension>& move, std::size_t stride,
                                               float* floats) {
  // Sweeping runs one block behind conversion, because data just written in fours is slow to read in eights.
  for (std::size_t block = 0; block <= move.blocks.size(); ++block) {
    if (block < move.blocks.size()) convert(move, move.blocks[block], floats + stride * block);
    if (block > 0) sweep<F>(move, block - 1, floats + stride * (block - 1));
  }
}
template <int Dimension>
void move_in_eights(const Move<Dimension>& move, std::size_t stride, float* floats) {
  move_blocks<FloatLanesIn<8>>(move, stride, floats);
}
template <int Dimension>
void move_in_fours(const Move<Dimension>& move, std::size_t stride, float* floats) {
  move_blocks<FloatLanesIn<4>>(move, stride, floats);
}

}  // namespace

template <int Dimension>
BlockBeads<Dimension>::BlockBeads(std::span<const BeadBlock> blocks, int degree)
    : blocks_(blocks),
      controls_(static_cast<std::size_t>(degree) + 1),
      stride_(Layout<Dimension>::size(controls_)),
      floats_(stride_ * blocks.size()),
      reaches_(row * blocks.size() + loop_padding),
      boxes_(blocks.size()) {
  for (std::vector<float>& of_axis : centers_) of_axis.resize(row * blocks.size() + loop_padding);
  for (const BeadBlock& block : blocks) necklaces_.push_back(block.necklace);
}

template <int Dimension>
Blocks<Dimension> BlockBeads<Dimension>::swept() {
  Blocks<Dimension> swept;
  for (std::size_t axis = 0; axis < Layout<Dimension>::axes; ++axis)
    swept.centers[axis] = centers_[axis].data();
  swept.radii = reaches_.data();
  swept.boxes = boxes_.data();
  return swept;
}

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
  const Move<Dimension> move{&curves, blocks_, middle.data(), drift_.data(), scale, controls_, swept()};
  if (target_ != VectorTarget::plain) {
    in_long_lanes<&move_in_eights<Dimension>>(move, stride_, floats_.data());
  } else {
    in_long_lanes<&move_in_fours<Dimension>>(move, stride_, floats_.data());
  }
}

// Sets the drift to the mean motion of a sample of beads, control point by control point. Any numbers would
// be correct.
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

// Runs only if the radii differ from the previous step.
template <int Dimension>
void BlockBeads<Dimension>::set_radii(const Curves<Dimension>& curves, double scale) {
  using L = Layout<Dimension>;
  constexpr double spare = 0x1p-19;
  const std::size_t beads = curves.bead_count();
  // Handles all radii at once if they are stored consecutively.
  const std::size_t at_once = beads > 1 && curves.radii(1) == curves.radii(0) + controls_ ? beads : 1;
  bool same = scale == scale_of_radii_ && radii_.size() == beads * controls_;
  const double* known = radii_.data();
  for (std::size_t bead = 0; same && bead < beads; bead += at_once, known += at_once * controls_)
    same = std::equal(known, known + at_once * controls_, curves.radii(static_cast<BeadId>(bead)));
  if (same) return;
  scale_of_radii_ = scale;
  radii_.clear();
  for (BeadId bead = 0; bead < beads; ++bead)
    radii_.insert(radii_.end(), curves.radii(bead), curves.radii(bead) + controls_);
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
                                    PairsOfBlocks& pairs) {
  if (!usable_) {
    for (const BlockPair& pair : blocks) look_at_all(blocks_[pair.first], blocks_[pair.second], apart, pairs);
    return;
  }
  const LanesAsked asked{necklaces_.data(), apart, true, true, false};
  const BlockNumbers numbers{floats_.data(), stride_, controls_};
  Look look;
  for (; !blocks.empty(); blocks = blocks.subspan(std::min(block_pairs_at_once, blocks.size()))) {
    const auto some = blocks.first(std::min(block_pairs_at_once, blocks.size()));
    for (std::size_t p = 0; p < some.size(); ++p) {
      look.firsts[p] = some[p].first;
      look.seconds[p] = some[p].second;
    }
    std::uint64_t groups = 0;
    look.count = block_loops<Dimension>(target_).compare_unequal(
        swept(), {look.firsts.data(), look.seconds.data()}, some.size(), asked, 0, look.scratch.data(),
        {look.groups.data(), look.unclear.data()}, groups);
    pairs.proved_apart += groups;
    if (target_ != VectorTarget::plain) {
      in_long_lanes<&prove_in_eights<Dimension>>(numbers, look);
    } else {
      in_long_lanes<&prove_in_fours<Dimension>>(numbers, look);
    }
    for (std::size_t k = 0; k < look.count; ++k) {
      if ((look.unclear[k] | look.inside[k]) != 0) --pairs.proved_apart;
      const BeadId first = blocks_[look.first_block(k)].first + look.first_bead(k);
      const BeadId second = blocks_[look.second_block(k)].first + look.second_bead(k);
      for_each_pair(first, second, look.unclear[k], [&](BeadId bead, BeadId other) {
        pairs.unclear.push_back({bead, other});
      });
      if (list_overlapping)
        for_each_pair(first, second, look.inside[k], [&](BeadId bead, BeadId other) {
          pairs.overlapping.push_back({bead, other});
        });
    }
  }
}

template <int Dimension>
void BlockBeads<Dimension>::look_at_all(const BeadBlock& a, const BeadBlock& b, BeadId apart,
                                        PairsOfBlocks& pairs) const {
  const bool along = a.necklace == b.necklace;
  const BeadId end = b.first + b.count;
  for (BeadId bead = a.first; bead < a.first + a.count; ++bead) {
    if (along && end - bead <= apart) continue;
    for (BeadId other = along ? std::max(b.first, bead + apart) : b.first; other < end; ++other)
      pairs.unclear.push_back({bead, other});
  }
}

template class BlockBeads<2>;
template class BlockBeads<3>;

}  // namespace kds
