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
// larger and smaller; then the sides of the box around the larger balls, control point by control point.
template <int Dimension>
struct Layout {
  static constexpr std::size_t axes = static_cast<std::size_t>(Dimension);

  static constexpr std::size_t coordinates(std::size_t k, std::size_t axis) {
    return row * (k * axes + axis);
  }
  static constexpr std::size_t larger(std::size_t controls) { return row * controls * axes; }
  static constexpr std::size_t smaller(std::size_t controls) { return larger(controls) + row; }
  static constexpr std::size_t box(std::size_t controls, std::size_t k, std::size_t axis) {
    return smaller(controls) + row + 2 * (k * axes + axis);
  }
  static constexpr std::size_t size(std::size_t controls) {
    return (box(controls, controls, 0) + row - 1) / row * row;
  }
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

  /// Which beads of a block may meet the box of another.
  [[nodiscard, gnu::always_inline]] std::uint32_t near_box(const float* beads, const float* other) const {
    BitsOf<F> near;
    for (std::size_t first = 0; first < row; first += F::width) {
      const F radius = load<F>(beads + L::larger(controls()) + first);
      typename F::Mask apart{};
      for (std::size_t axis = 0; axis < L::axes; ++axis) {
        typename F::Mask above = ~typename F::Mask{}, below = above;
        for (std::size_t k = 0; k < controls(); ++k) {
          const F x = load<F>(beads + L::coordinates(k, axis) + first);
          const float* const sides = other + L::box(controls(), k, axis);
          above &= x - radius > F(sides[1]);
          below &= F(sides[0]) > x + radius;
        }
        apart |= above | below;
      }
      near.add(~apart, first);
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

/// What a look at two blocks needs.
struct TwoBlocks {
  const float *a, *b;
  const BeadBlock *first, *second;
  std::size_t controls;
  BeadId apart;
};

/// What it finds out about a bead of the first block: one bit a bead of the second.
struct RowFound {
  std::uint32_t bead, asked, inside, unclear;
};
using RowsFound = std::array<RowFound, row>;

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
[[nodiscard, gnu::always_inline]] inline std::size_t look_at_two(const TwoBlocks& two, RowsFound& found) {
  const Scan<F, Dimension, Controls> scan{two.controls};
  std::uint32_t rows = two.first->bits(), columns = two.second->bits();
  if (two.a != two.b) {
    rows &= scan.near_box(two.a, two.b);
    if (rows == 0) return 0;
    columns &= scan.near_box(two.b, two.a);
    if (columns == 0) return 0;
  }
  const std::int64_t offset = chain_offset(*two.first, *two.second);
  std::size_t count = 0;
  for (; rows != 0; rows &= rows - 1) {
    const auto bead = static_cast<std::uint32_t>(std::countr_zero(rows));
    const std::uint32_t asked = columns & far_enough(bead, offset, two.apart);
    if (asked == 0) continue;
    const RowBits bits = scan.one_row(two.a, bead, two.b);
    found[count++] = {bead, asked, asked & bits.inside, asked & ~(bits.apart | bits.inside)};
  }
  return count;
}

template <class F, int Dimension>
[[nodiscard, gnu::always_inline]] inline std::size_t look_at_two(const TwoBlocks& two, RowsFound& found) {
  return two.controls == 2 ? look_at_two<F, Dimension, 2>(two, found)
                           : look_at_two<F, Dimension, 0>(two, found);
}

template <int Dimension>
[[KDS_FLOAT_LANES_TARGETS]] std::size_t look_in_eights(const TwoBlocks& two, RowsFound& found) {
  return look_at_two<FloatLanesIn<8>, Dimension>(two, found);
}
template <int Dimension>
[[KDS_FLOAT_LANES_TARGETS]] std::size_t look_in_fours(const TwoBlocks& two, RowsFound& found) {
  return look_at_two<FloatLanesIn<4>, Dimension>(two, found);
}

/// Calls visit(bead) for each bit.
template <class Visit>
void for_each_bead(const BeadBlock& block, std::uint32_t bits, const Visit& visit) {
  for (; bits != 0; bits &= bits - 1) visit(block.first + static_cast<BeadId>(std::countr_zero(bits)));
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
      floats_(stride_ * blocks.size()) {}

template <int Dimension>
void BlockBeads<Dimension>::move_to(const Curves<Dimension>& curves,
                                    const std::array<double, Dimension>& middle, double half) {
  using L = Layout<Dimension>;
  int exponent = 0;
  usable_ = std::isfinite(half) && half > 0;
  if (usable_) (void)std::frexp(half, &exponent);
  usable_ = usable_ && std::abs(exponent) < 1000;
  if (!usable_) return;
  const double scale = std::ldexp(1.0, -exponent);
  constexpr double spare = 0x1p-19;
  for (std::size_t block = 0; block < blocks_.size(); ++block) {
    const BeadBlock& beads = blocks_[block];
    float* const numbers = &floats_[block * stride_];
    float* const larger = numbers + L::larger(controls_);
    float* const smaller = numbers + L::smaller(controls_);
    for (std::size_t i = 0; i < beads.count; ++i) {
      const auto bead = beads.first + static_cast<BeadId>(i);
      const double* const radii = curves.radii(bead);
      const auto [least, most] = std::minmax_element(radii, radii + controls_);
      larger[i] = static_cast<float>(scale * *most * (1 + 0x1p-20) + spare);
      smaller[i] = static_cast<float>(scale * *least * (1 - 0x1p-20) - spare);
      for (std::size_t k = 0; k < controls_; ++k) {
        const double* const point = curves.control_point(bead, static_cast<int>(k));
        for (std::size_t axis = 0; axis < L::axes; ++axis)
          numbers[L::coordinates(k, axis) + i] = static_cast<float>(scale * (point[axis] - middle[axis]));
      }
    }
    for (std::size_t k = 0; k < controls_; ++k) {
      for (std::size_t axis = 0; axis < L::axes; ++axis) {
        const float* const x = numbers + L::coordinates(k, axis);
        float low = x[0] - larger[0], high = x[0] + larger[0];
        for (std::size_t i = 1; i < beads.count; ++i) {
          low = std::min(low, x[i] - larger[i]);
          high = std::max(high, x[i] + larger[i]);
        }
        numbers[L::box(controls_, k, axis)] = low;
        numbers[L::box(controls_, k, axis) + 1] = high;
      }
    }
  }
}

template <int Dimension>
void BlockBeads<Dimension>::look_at(std::size_t first, std::size_t second, BeadId apart,
                                    bool list_overlapping, PairsOfBlocks& pairs) const {
  if (!usable_) return look_at_all(blocks_[first], blocks_[second], apart, pairs);
  static const bool long_vectors = has_long_vectors();
  const BeadBlock &a = blocks_[first], &b = blocks_[second];
  const TwoBlocks two{&floats_[first * stride_], &floats_[second * stride_], &a, &b, controls_, apart};
  RowsFound found;
  const std::size_t rows =
      long_vectors ? look_in_eights<Dimension>(two, found) : look_in_fours<Dimension>(two, found);
  for (std::size_t r = 0; r < rows; ++r) {
    const RowFound& of = found[r];
    const BeadId bead = a.first + of.bead;
    pairs.looked_at += static_cast<std::uint64_t>(std::popcount(of.asked));
    pairs.overlapping_count += static_cast<std::uint64_t>(std::popcount(of.inside));
    for_each_bead(b, of.unclear, [&](BeadId other) { pairs.unclear.push_back({bead, other}); });
    if (list_overlapping)
      for_each_bead(b, of.inside, [&](BeadId other) { pairs.overlapping.push_back({bead, other}); });
  }
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
