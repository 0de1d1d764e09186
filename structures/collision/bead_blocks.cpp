#include "structures/collision/bead_blocks.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <stdexcept>

#include "motions/base/floating_point_scope.h"

namespace kds {

namespace {

// Spreads the bits to every `spread`-th position from the lowest.
std::uint64_t spread_bits(std::uint64_t bits, int spread) {
  std::uint64_t result = 0;
  for (int k = 0; bits >> k != 0; ++k) result |= (bits >> k & 1) << (k * spread);
  return result;
}

constexpr std::size_t gathered_blocks = 64;  // maximum number of blocks copied at once

}  // namespace

template <int Dimension>
void MortonOrder<Dimension>::make_keys(const Balls<Dimension>& balls, int bits) {
  const auto cells = static_cast<double>((std::size_t{1} << bits) - 1);
  const SceneBox<Dimension> box = scene_box(balls);
  double longest = 0;
  for (std::size_t axis = 0; axis < Dimension; ++axis)
    longest = std::max(longest, 0.5 * box.high[axis] - 0.5 * box.low[axis]);
  // If the scene is so small that this ratio is infinite, beads stay in the order of their numbers. Any order
  // is valid.
  const double cells_a_length = longest > 0 && cells / longest < 0x1p1000 ? cells / longest : 0.0;
  std::vector<std::uint64_t> spread(std::size_t{1} << bits);
  for (std::size_t k = 0; k < spread.size(); ++k) spread[k] = spread_bits(k, Dimension);
  keys_.resize(balls.size());
  for (std::size_t b = 0; b < keys_.size(); ++b) {
    std::uint64_t key = 0;
    for (std::size_t axis = 0; axis < Dimension; ++axis) {
      const double along = 0.5 * balls.coordinates(axis)[b] - 0.5 * box.low[axis];
      const double cell = std::min(along * cells_a_length, cells);
      key |= spread[static_cast<std::size_t>(static_cast<std::int64_t>(cell))] << axis;
    }
    keys_[b] = key << 32 | b;
  }
}

// Radix sort in two passes: by the lower half of the bits, then by the upper half.
template <int Dimension>
void MortonOrder<Dimension>::sort_keys(int key_bits) {
  const int half = (key_bits + 1) / 2;
  const std::uint64_t mask = (std::uint64_t{1} << half) - 1;
  std::vector<std::uint32_t> starts;
  more_keys_.resize(keys_.size());
  for (const int shift : {32, 32 + half}) {
    starts.assign(mask + 2, 0);
    for (const std::uint64_t key : keys_) ++starts[(key >> shift & mask) + 1];
    for (std::size_t k = 0; k + 1 < starts.size(); ++k) starts[k + 1] += starts[k];
    for (const std::uint64_t key : keys_) more_keys_[starts[key >> shift & mask]++] = key;
    keys_.swap(more_keys_);
  }
}

template <int Dimension>
void MortonOrder<Dimension>::sort(const Balls<Dimension>& balls, std::vector<BeadId>& order) {
  const int bits = (std::bit_width(4 * balls.size()) + Dimension - 1) / Dimension;
  make_keys(balls, bits);
  sort_keys(bits * Dimension);
  order.resize(keys_.size());
  for (std::size_t k = 0; k < keys_.size(); ++k) order[k] = static_cast<BeadId>(keys_[k]);
}

template class MortonOrder<2>;
template class MortonOrder<3>;

template <int Dimension>
BeadBlocks<Dimension>::BeadBlocks(PairsAsked asked, const BlockLoops<Dimension>& loops, BlockOrder order)
    : asked_(std::move(asked)), loops_(loops) {
  refuse_groups(asked_, "a block tree");
  for (const BeadRange& range : asked_.necklaces) {
    if (range.first != beads_ || range.last < range.first)
      throw std::invalid_argument("expected a scene's necklaces one after the other");
    beads_ = std::size_t{range.last} + 1;
  }
  if (asked_.apart < 1) throw std::invalid_argument("expected beads at least 1 apart along the chain");
  arrange(order);
}

template <int Dimension>
void BeadBlocks<Dimension>::arrange(BlockOrder order) {
  order_ = order;
  first_bead_.clear();
  necklace_of_block_.clear();
  if (order == BlockOrder::sequence) {
    for (std::uint32_t n = 0; n < asked_.necklaces.size(); ++n) {
      const BeadRange& range = asked_.necklaces[n];
      for (std::size_t bead = range.first; bead <= range.last; bead += beads_in_block) {
        first_bead_.push_back(static_cast<BeadId>(bead));
        necklace_of_block_.push_back(n);
      }
    }
  } else {
    necklace_of_block_.assign((beads_ + beads_in_block - 1) / beads_in_block, 0);
  }
  const std::size_t blocks = necklace_of_block_.size();
  for (auto& axis : centers_)
    axis.assign((blocks + 1) * beads_in_block, std::numeric_limits<float>::quiet_NaN());
  radii_.assign((blocks + 1) * beads_in_block, 0.0F);
  boxes_.resize(blocks);
  levels_.clear();
  stretched_.assign((blocks + children_of_node - 1) / children_of_node, 0);
  for (std::size_t nodes = blocks; nodes > 1 || levels_.empty();) {
    nodes = (nodes + children_of_node - 1) / children_of_node;
    levels_.emplace_back(std::max<std::size_t>(nodes, 1));
  }
}

template <int Dimension>
Blocks<Dimension> BeadBlocks<Dimension>::view() {
  Blocks<Dimension> here{{}, radii_.data(), boxes_.data()};
  for (std::size_t axis = 0; axis < Dimension; ++axis) here.centers[axis] = centers_[axis].data();
  return here;
}

template <int Dimension>
BlockSource<Dimension> BeadBlocks<Dimension>::source_of(double gap, double radius) const {
  BlockSource<Dimension> source{};
  source.shift = conversion_.shift;
  source.scale = conversion_.scale;
  source.radius_factor = conversion_.scale * (1 + 0x1p-20);
  source.radius_added = conversion_.float_radius(0.5 * gap);
  source.radius = static_cast<float>(radius * source.radius_factor + source.radius_added);
  return source;
}

template <int Dimension>
std::size_t BeadBlocks<Dimension>::beads_of(std::size_t block) const {
  const std::size_t behind =
      order_ == BlockOrder::spatial
          ? beads_ - beads_in_block * block
          : std::size_t{asked_.necklaces[necklace_of_block_[block]].last} + 1 - first_bead_[block];
  return std::min(behind, beads_in_block);
}

// Blocks are copied if their beads are not consecutive, too few, or turned. Missing beads are filled with the
// last bead.
template <int Dimension>
template <class Bead>
BlockSource<Dimension> BeadBlocks<Dimension>::gather(const Balls<Dimension>& balls,
                                                     BlockSource<Dimension> source, std::size_t count,
                                                     const Bead& bead) {
  const std::size_t lanes = (count + beads_in_block - 1) / beads_in_block * beads_in_block;
  for (std::size_t i = 0; i < gathered_.size(); ++i) {
    const bool are_radii = i == Dimension;
    if (are_radii && equal_) continue;
    const double* numbers = are_radii ? balls.radii() : balls.coordinates(i);
    std::vector<double>& copy = gathered_[i];
    copy.resize(gathered_blocks * beads_in_block);
    for (std::size_t k = 0; k < count; ++k) copy[k] = numbers[bead(k)];
    for (std::size_t k = count; k < lanes; ++k) copy[k] = copy[count - 1];
    (are_radii ? source.radii : source.centers[i]) = copy.data();
  }
  return conversion_.axes ? turned_to_axes(source, lanes) : source;
}

// Like gather, but by a conversion with axes.
template <int Dimension>
BlockSource<Dimension> BeadBlocks<Dimension>::turned_to_axes(BlockSource<Dimension> source,
                                                             std::size_t lanes) {
  std::array<double*, static_cast<std::size_t>(Dimension)> turned;
  for (std::size_t axis = 0; axis < Dimension; ++axis) {
    gathered_[axis].resize(gathered_blocks * beads_in_block);
    turned[axis] = gathered_[axis].data();
  }
  turn_to_axes(conversion_, source.centers, turned, lanes);
  std::copy(turned.begin(), turned.end(), source.centers.begin());
  source.shift = {};
  source.scale = 1;
  return source;
}

template <int Dimension>
template <class Visit>
void BeadBlocks<Dimension>::with_sources(const Balls<Dimension>& balls, BlockSource<Dimension> source,
                                         const Visit& visit) {
  if (order_ == BlockOrder::spatial) {
    for (std::size_t first = 0; first < boxes_.size(); first += gathered_blocks) {
      const std::size_t bead = first * beads_in_block,
                        last = std::min(first + gathered_blocks, boxes_.size());
      visit(gather(balls, source, std::min(last * beads_in_block, beads_) - bead,
                   [&](std::size_t k) { return sorted_[bead + k]; }),
            first, last);
    }
    return;
  }
  std::size_t block = 0;
  for (const BeadRange& range : asked_.necklaces) {
    const std::size_t count = std::size_t{range.last} - range.first + 1, whole = count / beads_in_block;
    const std::size_t at_once = conversion_.axes ? gathered_blocks : std::max<std::size_t>(whole, 1);
    for (std::size_t first = 0; first < whole; first += at_once) {
      const std::size_t bead = range.first + first * beads_in_block, some = std::min(at_once, whole - first);
      for (std::size_t axis = 0; axis < Dimension; ++axis)
        source.centers[axis] = balls.coordinates(axis) + bead;
      source.radii = balls.radii() + bead;
      visit(conversion_.axes ? turned_to_axes(source, some * beads_in_block) : source, block + first,
            block + first + some);
    }
    block += whole;
    if (const std::size_t rest = count % beads_in_block; rest > 0) {
      visit(gather(balls, source, rest,
                   [&](std::size_t k) { return range.first + whole * beads_in_block + k; }),
            block, block + 1);
      ++block;
    }
  }
}

// Only the last of several blocks may have lanes without a bead.
template <int Dimension>
void BeadBlocks<Dimension>::clear_lanes_behind(std::size_t block) {
  const std::size_t beads = beads_of(block);
  for (auto& axis : centers_)
    std::fill_n(axis.begin() + static_cast<std::ptrdiff_t>(beads_in_block * block + beads),
                beads_in_block - beads, std::numeric_limits<float>::quiet_NaN());
}

template <int Dimension>
BlockExtent BeadBlocks<Dimension>::fill_floats(const Balls<Dimension>& balls, double gap) {
  BlockExtent extent;
  const auto loop = equal_ ? loops_.fill_equal : loops_.fill_unequal;
  const BlockSource<Dimension> source = source_of(gap, balls.radius(0));
  limit_ = (source.radius + source.radius) * (source.radius + source.radius);
  with_sources(balls, source, [&](const BlockSource<Dimension>& some, std::size_t first, std::size_t last) {
    const BlockExtent e = loop(some, first, last, view(), levels_[0].data());
    extent.coordinate = std::max(extent.coordinate, e.coordinate);
    extent.radius = std::max(extent.radius, e.radius);
    clear_lanes_behind(last - 1);
  });
  return extent;
}

// Returns false if the conversion cannot hold the beads.
template <int Dimension>
bool BeadBlocks<Dimension>::fill_again(const Balls<Dimension>& balls, std::span<const std::uint32_t> blocks) {
  const auto loop = equal_ ? loops_.fill_equal : loops_.fill_unequal;
  const BlockSource<Dimension> source = source_of(gap_, balls.radius(0));
  bool fits = true;
  for (const std::uint32_t block : blocks) {
    const BlockSource<Dimension> its =
        gather(balls, source, beads_of(block), [&](std::size_t k) { return bead_at(block, k); });
    const BlockExtent extent = loop(its, block, block + 1, view(), levels_[0].data());
    clear_lanes_behind(block);
    fits = fits && extent.coordinate <= conversion_.bound;
  }
  for (const std::uint32_t block : blocks) find_stretched(block > 0 ? block - 1 : 0, block + 1);
  return fits;
}

template <int Dimension>
void BeadBlocks<Dimension>::fill(const Balls<Dimension>& balls, double gap) {
  equal_ = balls.equal_radii();
  if (order_ == BlockOrder::spatial) {
    morton_order_.sort(balls, sorted_);
    sorted_.resize(beads_ + beads_in_block);  // read by lanes without a bead too
  }
  const auto fits = [this](const BlockExtent& e) {
    return e.coordinate <= conversion_.bound && e.radius <= largest_float_radius;
  };
  const auto blunt = [this](const BlockExtent& e) {  // and a conversion for this scene is finer
    return e.coordinate < 0x1p-6 * conversion_.bound && conversion_.bound > 0x1p-20;
  };
  BlockExtent extent;
  if (conversion_.bound > 0) extent = fill_floats(balls, gap);
  if (conversion_.bound == 0 || !fits(extent) || blunt(extent)) {
    conversion_ = fit_float_conversion(scene_box(balls), gap, conversion_.axes);
    extent = fill_floats(balls, gap);
    if (!fits(extent)) throw std::logic_error("a conversion to floats does not hold its own scene");
  }
  gap_ = gap;
  // A step that the loop accepts is shorter than computed by at most 2^-20 M, the loss of differences and
  // products (below 15 u M). Even so, `apart` such steps are longer than any distance that floats call near.
  least_ahead_ =
      static_cast<float>(2.0 * extent.radius * (1 + 0x1p-16) / asked_.apart + 0x1p-18 * conversion_.bound);
  find_stretched(0, boxes_.size());
  for (std::size_t level = 0; level + 1 < levels_.size(); ++level)
    loops_.unite(levels_[level].data(), 0, levels_[level].size(), levels_[level + 1].data());
}

// Marks blocks that, alone and with the next block, contain no near pair that is asked about: each bead lies
// far enough ahead of the bead before it in one direction. The next block must belong to the same necklace.
template <int Dimension>
void BeadBlocks<Dimension>::find_stretched(std::size_t first, std::size_t last) {
  if (!goes_along()) return;
  loops_.stretch(view(), first, std::min(last, boxes_.size() - 1), least_ahead_, stretched_.data());
  for (std::size_t block = first; block < last; ++block)
    if (block + 1 == boxes_.size() || necklace_of_block_[block] != necklace_of_block_[block + 1])
      stretched_[block / children_of_node] &= static_cast<std::uint16_t>(~(1U << block % children_of_node));
}

template <int Dimension>
void BeadBlocks<Dimension>::turn(const std::optional<Axes<Dimension>>& axes) {
  // A coordinate along another axis is less than twice as large.
  if (axes.has_value() != conversion_.axes.has_value()) conversion_.bound *= axes ? 2 : 0.5;
  conversion_.axes = axes;
}

template <int Dimension>
std::span<const double> BeadBlocks<Dimension>::strayed_by_block(const Balls<Dimension>& balls) {
  const FloatingPointScope to_nearest;
  if (balls.size() != beads_) throw std::invalid_argument("balls and necklaces must be of the same beads");
  strays_.resize(boxes_.size());
  with_sources(balls, source_of(0, 0), [&](BlockSource<Dimension> some, std::size_t first, std::size_t last) {
    for (std::size_t block = first; block < last; ++block) {
      strays_[block] = conversion_.farthest(loops_.stray(some, block, block + 1, view()));
      for (const double*& axis : some.centers) axis += beads_in_block;
    }
  });
  return strays_;
}

template <int Dimension>
double BeadBlocks<Dimension>::strayed(const Balls<Dimension>& balls) {
  const FloatingPointScope to_nearest;
  if (balls.size() != beads_) throw std::invalid_argument("balls and necklaces must be of the same beads");
  float farthest = 0;
  with_sources(balls, source_of(0, 0),
               [&](const BlockSource<Dimension>& some, std::size_t first, std::size_t last) {
                 farthest = std::max(farthest, loops_.stray(some, first, last, view()));
               });
  return conversion_.farthest(farthest);
}

template class BeadBlocks<2>;
template class BeadBlocks<3>;

}  // namespace kds
