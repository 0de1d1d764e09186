#include "structures/collision/block_tree.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <span>
#include <stdexcept>

#include "motions/base/floating_point_guard.h"
#include "structures/blocks/bond_axes.h"

namespace kds {

namespace {

constexpr std::size_t sample_stride = 8;

// What a search has cost, in comparisons of four beads with four, about 2 ns each.
template <class Counts>
double work_of(const Counts& counts) {
  return 10.0 * static_cast<double>(counts.node_pairs) + 1.5 * static_cast<double>(counts.block_pairs) +
         static_cast<double>(counts.group_pairs);
}
// What sorting and a search of sorted beads cost a block, and turning boxes and a search in them.
constexpr double work_of_sorted_block = 230, work_of_turned_block = 45;
constexpr std::size_t fewest_beads_to_choose = 2000;
constexpr std::size_t gathered_blocks = 64;  // at most, are copied at once

// Of a scene larger than a cache, so many pairs before it is looked at.
constexpr std::size_t fetched_ahead = 2 * sample_stride;
template <int Dimension>
void fetch(const BlockNode<Dimension>& node) {
  const char* const bytes = reinterpret_cast<const char*>(&node);
  for (std::size_t line = 0; line < sizeof node; line += alignof(BlockNode<Dimension>))
    __builtin_prefetch(bytes + line);
}

}  // namespace

template <int Dimension>
BlockTree<Dimension>::BlockTree(PairsAsked asked, std::optional<BlockOrder> order, VectorTarget target)
    : asked_(std::move(asked)), wanted_(order), kernels_(block_kernels<Dimension>(target)), beads_(0) {
  for (const BeadRange& range : asked_.necklaces) {
    if (range.first != beads_ || range.last < range.first)
      throw std::invalid_argument("expected a scene's necklaces one after the other");
    beads_ = std::size_t{range.last} + 1;
  }
  if (asked_.apart < 1) throw std::invalid_argument("expected beads at least 1 apart along the chain");
  make_blocks(wanted_.value_or(BlockOrder::sequence));
  groups_.resize(16 * block_pairs_at_once + kernel_padding);
  near_groups_.resize(groups_.size());
  near_beads_.resize(groups_.size());
}

template <int Dimension>
void BlockTree<Dimension>::make_blocks(BlockOrder order) {
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
Blocks<Dimension> BlockTree<Dimension>::blocks() {
  Blocks<Dimension> here{{}, radii_.data(), boxes_.data()};
  for (std::size_t axis = 0; axis < Dimension; ++axis) here.centers[axis] = centers_[axis].data();
  return here;
}

template <int Dimension>
BlockSource<Dimension> BlockTree<Dimension>::source_of(double gap, double radius) const {
  BlockSource<Dimension> source{};
  source.shift = frame_.shift;
  source.scale = frame_.scale;
  source.radius_factor = frame_.scale * (1 + 0x1p-20);
  source.radius_added = frame_.float_radius(0.5 * gap);
  source.radius = static_cast<float>(radius * source.radius_factor + source.radius_added);
  return source;
}

template <int Dimension>
std::size_t BlockTree<Dimension>::beads_of(std::size_t block) const {
  const std::size_t behind =
      order_ == BlockOrder::spatial
          ? beads_ - beads_in_block * block
          : std::size_t{asked_.necklaces[necklace_of_block_[block]].last} + 1 - first_bead_[block];
  return std::min(behind, beads_in_block);
}

// Blocks whose beads do not lie one after the other, or are too few, or are turned, are copied; a bead in
// want stands for the last.
template <int Dimension>
template <class Bead>
BlockSource<Dimension> BlockTree<Dimension>::gather(const Balls<Dimension>& balls,
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
  return frame_.axes ? placed(source, lanes) : source;
}

// The same in a frame with axes.
template <int Dimension>
BlockSource<Dimension> BlockTree<Dimension>::placed(BlockSource<Dimension> source, std::size_t lanes) {
  std::array<double*, static_cast<std::size_t>(Dimension)> places;
  for (std::size_t axis = 0; axis < Dimension; ++axis) {
    gathered_[axis].resize(gathered_blocks * beads_in_block);
    places[axis] = gathered_[axis].data();
  }
  place_along_axes(frame_, source.centers, places, lanes);
  std::copy(places.begin(), places.end(), source.centers.begin());
  source.shift = {};
  source.scale = 1;
  return source;
}

template <int Dimension>
template <class Visit>
void BlockTree<Dimension>::with_sources(const Balls<Dimension>& balls, BlockSource<Dimension> source,
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
    const std::size_t at_once = frame_.axes ? gathered_blocks : std::max<std::size_t>(whole, 1);
    for (std::size_t first = 0; first < whole; first += at_once) {
      const std::size_t bead = range.first + first * beads_in_block, some = std::min(at_once, whole - first);
      for (std::size_t axis = 0; axis < Dimension; ++axis)
        source.centers[axis] = balls.coordinates(axis) + bead;
      source.radii = balls.radii() + bead;
      visit(frame_.axes ? placed(source, some * beads_in_block) : source, block + first,
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
void BlockTree<Dimension>::clear_lanes_behind(std::size_t block) {
  const std::size_t beads = beads_of(block);
  for (auto& axis : centers_)
    std::fill_n(axis.begin() + static_cast<std::ptrdiff_t>(beads_in_block * block + beads),
                beads_in_block - beads, std::numeric_limits<float>::quiet_NaN());
}

template <int Dimension>
BlockExtent BlockTree<Dimension>::fill(const Balls<Dimension>& balls, double gap) {
  BlockExtent extent;
  const auto kernel = equal_ ? kernels_.fill_equal : kernels_.fill_unequal;
  const BlockSource<Dimension> source = source_of(gap, balls.radius(0));
  limit_ = (source.radius + source.radius) * (source.radius + source.radius);
  with_sources(balls, source, [&](const BlockSource<Dimension>& some, std::size_t first, std::size_t last) {
    const BlockExtent e = kernel(some, first, last, blocks(), levels_[0].data());
    extent.coordinate = std::max(extent.coordinate, e.coordinate);
    extent.radius = std::max(extent.radius, e.radius);
    clear_lanes_behind(last - 1);
  });
  return extent;
}

// False where the frame does not hold them.
template <int Dimension>
bool BlockTree<Dimension>::fill_again(const Balls<Dimension>& balls, std::span<const std::uint32_t> blocks) {
  const auto kernel = equal_ ? kernels_.fill_equal : kernels_.fill_unequal;
  const BlockSource<Dimension> source = source_of(gap_, balls.radius(0));
  bool fits = true;
  for (const std::uint32_t block : blocks) {
    const BlockSource<Dimension> its =
        gather(balls, source, beads_of(block), [&](std::size_t k) { return bead_at(block, k); });
    const BlockExtent extent = kernel(its, block, block + 1, this->blocks(), levels_[0].data());
    clear_lanes_behind(block);
    fits = fits && extent.coordinate <= frame_.bound;
  }
  return fits;
}

template <int Dimension>
void BlockTree<Dimension>::build(const Balls<Dimension>& balls, double gap) {
  equal_ = balls.equal_radii();
  if (order_ == BlockOrder::spatial) {
    morton_order_.sort(balls, sorted_);
    sorted_.resize(beads_ + beads_in_block);  // lanes without a bead name one
  }
  const auto fits = [this](const BlockExtent& e) {
    return e.coordinate <= frame_.bound && e.radius <= largest_float_radius;
  };
  const auto blunt = [this](const BlockExtent& e) {  // and a frame of this scene would not be
    return e.coordinate < 0x1p-6 * frame_.bound && frame_.bound > 0x1p-20;
  };
  BlockExtent extent;
  if (frame_.bound > 0) extent = fill(balls, gap);
  if (frame_.bound == 0 || !fits(extent) || blunt(extent)) {
    frame_ = fit_float_frame(scene_box(balls), gap, frame_.axes);
    extent = fill(balls, gap);
    if (!fits(extent)) throw std::logic_error("a frame of floats does not hold its own scene");
  }
  gap_ = gap;
  // Steps that the kernel finds to be so long are shorter by 2^-20 M at most, what differences and products
  // have lost (below 15 u M), and `apart` of them are still longer than floats call near.
  least_ahead_ =
      static_cast<float>(2.0 * extent.radius * (1 + 0x1p-16) / asked_.apart + 0x1p-18 * frame_.bound);
  find_stretched(0, boxes_.size());
  for (std::size_t level = 0; level + 1 < levels_.size(); ++level)
    kernels_.unite(levels_[level].data(), 0, levels_[level].size(), levels_[level + 1].data());
}

// Blocks in which, with the next, no two beads are near that are asked about: each bead lies so far ahead of
// the one before it in one direction. Beads of a necklace only: the next must be of the same.
template <int Dimension>
void BlockTree<Dimension>::find_stretched(std::size_t first, std::size_t last) {
  if (!goes_along()) return;
  kernels_.stretch(blocks(), first, std::min(last, boxes_.size() - 1), least_ahead_, stretched_.data());
  for (std::size_t block = first; block < last; ++block)
    if (block + 1 == boxes_.size() || necklace_of_block_[block] != necklace_of_block_[block + 1])
      stretched_[block / children_of_node] &= static_cast<std::uint16_t>(~(1U << block % children_of_node));
}

// Whether any pair of the nodes' beads may be asked about: nodes of levels_[level], a <= b.
template <int Dimension>
bool BlockTree<Dimension>::asks(std::uint32_t a, std::uint32_t b, std::size_t level) const {
  if (order_ == BlockOrder::spatial) return true;
  const std::size_t width = children_of_node << (4 * level), blocks = first_bead_.size();
  const std::size_t first = a * width, last = std::min((b + 1) * width, blocks) - 1;
  if (!asked_.between &&
      necklace_of_block_[std::min((a + 1) * width, blocks) - 1] < necklace_of_block_[b * width])
    return false;
  if (necklace_of_block_[first] != necklace_of_block_[last]) return true;
  return asked_.within && (last - first + 1) * beads_in_block > asked_.apart;
}

// Marks of what is below levels_[level]: blocks or nodes.
template <int Dimension>
void BlockTree<Dimension>::keep_marked(PairList& pairs, std::size_t from, std::size_t level) const {
  const std::vector<unsigned char>& marks = marks_[level];
  std::size_t kept = from;
  for (std::size_t k = from; k < pairs.count; ++k) {
    const std::uint32_t a = pairs.first[k], b = pairs.second[k];
    pairs.first[kept] = a;
    pairs.second[kept] = b;
    kept += (marks[a] | marks[b]) != 0 ? 1 : 0;
  }
  pairs.count = kept;
}

template <int Dimension>
void BlockTree<Dimension>::expand_levels() {
  nodes_.count = 0;
  nodes_.reserve(1);
  nodes_.first[0] = nodes_.second[0] = 0;
  nodes_.count = 1;
  for (std::size_t level = levels_.size() - 1; level > 0; --level) {
    more_nodes_.count = 0;
    for (std::size_t k = 0; k < nodes_.count; ++k) {
      const std::uint32_t a = nodes_.first[k], b = nodes_.second[k];
      if (!asks(a, b, level)) continue;
      more_nodes_.reserve(children_of_node * children_of_node);
      const std::size_t before = more_nodes_.count;
      more_nodes_.count += kernels_.expand(levels_[level].data(), a, b, 0, more_nodes_.end());
      if (only_marked_) keep_marked(more_nodes_, before, level);
      ++counts_.node_pairs;
    }
    std::swap(nodes_, more_nodes_);
  }
}

template <int Dimension>
auto BlockTree<Dimension>::search(const Balls<Dimension>& balls, bool may_give_up) -> Outcome {
  counts_ = {};
  candidate_count_ = 0;
  expand_levels();
  block_pairs_.count = 0;
  const auto expand = [&](std::size_t k) {
    const std::uint32_t a = nodes_.first[k], b = nodes_.second[k];
    fetch(levels_[0][nodes_.second[std::min(k + fetched_ahead, nodes_.count - 1)]]);
    if (candidate_count_ > most_candidates_ || !asks(a, b, 0)) return;
    block_pairs_.reserve(children_of_node * children_of_node);
    const std::size_t before = block_pairs_.count;
    block_pairs_.count += kernels_.expand(levels_[0].data(), a, b, stretched_[a], block_pairs_.end());
    if (only_marked_) keep_marked(block_pairs_, before, 0);
    ++counts_.node_pairs;
    if (block_pairs_.count >= block_pairs_at_once) compare_blocks();
  };
  if (!may_give_up) {
    for (std::size_t k = 0; k < nodes_.count; ++k) expand(k);
  } else {
    const double before = work_of(counts_);
    for (std::size_t k = 0; k < nodes_.count; k += sample_stride) expand(k);
    compare_blocks();
    if (candidate_count_ > most_candidates_) return Outcome::found;
    const double sampled = static_cast<double>((nodes_.count + sample_stride - 1) / sample_stride);
    const double work = before + (work_of(counts_) - before) * static_cast<double>(nodes_.count) / sampled;
    const double work_a_block = work / static_cast<double>(boxes_.size());
    if (may_turn_ && work_a_block > work_of_turned_block) {
      may_turn_ = false;
      bond_axes_ = bond_axes(balls, frame_.scale);
      if (bond_axes_) return Outcome::better_turned;
    }
    if (work_a_block > work_of_sorted_block) return Outcome::better_sorted;
    for (std::size_t k = 0; k < nodes_.count; ++k)
      if (k % sample_stride != 0) expand(k);
  }
  compare_blocks();
  compare_along();
  return Outcome::found;
}

template <int Dimension>
void BlockTree<Dimension>::reserve_candidates(std::size_t groups) {
  const std::size_t needed = candidate_count_ + 16 * groups;
  if (candidates_.size() < needed) candidates_.resize(2 * needed);
}

template <int Dimension>
bool BlockTree<Dimension>::goes_along() const {
  return order_ == BlockOrder::sequence && asked_.within && asked_.apart <= farthest_along;
}

// Beads that are near along the chain: boxes of four in a row always meet, so all such pairs are looked at in
// a row, and no more when groups are compared.
template <int Dimension>
void BlockTree<Dimension>::compare_along() {
  if (!goes_along()) return;
  if (!only_marked_) return compare_along(0, boxes_.size());
  // A block's beads are also the second of pairs that begin in the block before.
  std::size_t done = 0;
  for (const std::uint32_t block : marked_blocks_) {
    compare_along(std::max<std::size_t>(done, block > 0 ? block - 1 : 0), block + 1);
    done = block + 1;
  }
}

template <int Dimension>
void BlockTree<Dimension>::compare_along(std::size_t first, std::size_t last) {
  const auto kernel = equal_ ? kernels_.along_equal : kernels_.along_unequal;
  constexpr std::size_t at_once = 2 * block_pairs_at_once;  // eight found a block at most
  for (; first < last; first += at_once) {
    const std::size_t near = kernel(blocks(), first, std::min(first + at_once, last), stretched_.data(),
                                    asked_.apart, limit_, {near_groups_.data(), near_beads_.data()});
    reserve_candidates(near);
    for (std::size_t k = 0; k < near; ++k) {
      const std::uint32_t block = near_groups_[k] / 8, along = near_groups_[k] % 8;
      const BeadId end = asked_.necklaces[necklace_of_block_[block]].last;
      for (unsigned bits = near_beads_[k]; bits != 0; bits &= bits - 1) {
        const BeadId bead = first_bead_[block] + static_cast<BeadId>(std::countr_zero(bits));
        if (end - bead < along) continue;  // the next necklace's
        if (only_marked_ && (marked_beads_[bead] | marked_beads_[bead + along]) == 0) continue;
        candidates_[candidate_count_++] = {bead, bead + along};
      }
    }
  }
}

template <int Dimension>
void BlockTree<Dimension>::compare_blocks() {
  const auto kernel = equal_ ? kernels_.compare_equal : kernels_.compare_unequal;
  const bool sequence = order_ == BlockOrder::sequence;
  const bool one_necklace = asked_.necklaces.size() == 1;
  const LanesAsked lanes{necklace_of_block_.data(), sequence ? asked_.apart : 1, !sequence || asked_.within,
                         !sequence || asked_.between, goes_along()};
  counts_.block_pairs += block_pairs_.count;
  for (std::size_t from = 0; from < block_pairs_.count; from += block_pairs_at_once) {
    const std::size_t count = std::min(block_pairs_at_once, block_pairs_.count - from);
    const NodePairs some{block_pairs_.first.data() + from, block_pairs_.second.data() + from};
    const std::size_t near = kernel(blocks(), some, count, lanes, limit_, groups_.data(),
                                    {near_groups_.data(), near_beads_.data()}, counts_.group_pairs);
    reserve_candidates(near);
    for (std::size_t k = 0; k < near; ++k) {
      const std::uint32_t group = near_groups_[k];
      const std::uint32_t a = some.first[group / 16], b = some.second[group / 16];
      const std::size_t g = group / 4 % 4, h = group % 4;
      for (unsigned bits = near_beads_[k]; bits != 0; bits &= bits - 1) {
        const auto bit = static_cast<std::size_t>(std::countr_zero(bits));
        BeadPair pair{bead_at(a, 4 * g + bit / 4), bead_at(b, 4 * h + bit % 4)};
        if (!sequence) {
          if (pair.second < pair.first) std::swap(pair.first, pair.second);
          const bool is_asked =
              one_necklace ? asked_.within && pair.second - pair.first >= asked_.apart : asked_.asks(pair);
          if (!is_asked) continue;
        }
        candidates_[candidate_count_++] = pair;
      }
    }
  }
  block_pairs_.count = 0;
}

template <int Dimension>
void BlockTree<Dimension>::turn(const std::optional<Axes<Dimension>>& axes) {
  // A coordinate along another axis is less than twice as large.
  if (axes.has_value() != frame_.axes.has_value()) frame_.bound *= axes ? 2 : 0.5;
  frame_.axes = axes;
}

template <int Dimension>
void BlockTree<Dimension>::choose_anew() {
  searches_since_choice_ = 0;
  may_turn_ = true;
  turn(std::nullopt);
  if (!wanted_ && order_ == BlockOrder::spatial) make_blocks(BlockOrder::sequence);
}

template <int Dimension>
void BlockTree<Dimension>::find_candidates(const Balls<Dimension>& balls, double gap, std::size_t most) {
  most_candidates_ = most;
  if (balls.size() != beads_) throw std::invalid_argument("balls and necklaces must be of the same beads");
  counts_ = {};
  candidate_count_ = 0;
  if (beads_ == 0) return;
  if (searches_since_choice_++ >= most_searches_as_chosen) choose_anew();
  const bool may_choose = !wanted_ && beads_ >= fewest_beads_to_choose;
  while (true) {
    build(balls, gap);
    const Outcome outcome = search(balls, may_choose && order_ == BlockOrder::sequence);
    if (outcome == Outcome::found) break;
    searches_since_choice_ = 0;
    if (outcome == Outcome::better_turned) {
      turn(*bond_axes_);
    } else {
      turn(std::nullopt);
      make_blocks(BlockOrder::spatial);
    }
  }
  counts_.candidates = candidate_count_;
}

template <int Dimension>
const std::vector<BeadPair>& BlockTree<Dimension>::pairs(const Balls<Dimension>& balls) {
  return *pairs_unless(balls, std::numeric_limits<std::size_t>::max());
}

template <int Dimension>
const std::vector<BeadPair>* BlockTree<Dimension>::pairs_unless(const Balls<Dimension>& balls,
                                                                std::size_t most) {
  const FloatingPointGuard to_nearest;
  find_candidates(balls, 0, most);
  if (candidate_count_ > most) return nullptr;
  pairs_.clear();
  for (std::size_t k = 0; k < candidate_count_; ++k)
    if (balls_meet(balls, candidates_[k].first, candidates_[k].second)) pairs_.push_back(candidates_[k]);
  sorter_.sort(pairs_, beads_);
  return &pairs_;
}

template <int Dimension>
std::optional<std::span<const BeadPair>> BlockTree<Dimension>::near_pairs(const Balls<Dimension>& balls,
                                                                          double gap, std::size_t most) {
  const FloatingPointGuard to_nearest;
  find_candidates(balls, gap, most);
  if (candidate_count_ > most) return std::nullopt;
  return std::span<const BeadPair>(candidates_.data(), candidate_count_);
}

template <int Dimension>
void BlockTree<Dimension>::mark(std::span<const std::uint32_t> blocks) {
  marked_blocks_.assign(blocks.begin(), blocks.end());
  marks_.resize(levels_.size());
  marks_[0].assign(boxes_.size(), 0);
  for (std::size_t level = 1; level < marks_.size(); ++level)
    marks_[level].assign(levels_[level - 1].size(), 0);
  marked_beads_.assign(beads_, 0);
  for (const std::uint32_t block : blocks) {
    for (std::size_t k = 0, count = beads_of(block); k < count; ++k) marked_beads_[bead_at(block, k)] = 1;
    std::size_t node = block;
    for (auto& marks : marks_) {
      marks[node] = 1;
      node /= children_of_node;
    }
  }
}

template <int Dimension>
std::optional<std::span<const BeadPair>> BlockTree<Dimension>::near_pairs_of(
    const Balls<Dimension>& balls, std::span<const std::uint32_t> blocks, std::size_t most) {
  const FloatingPointGuard to_nearest;
  if (balls.size() != beads_) throw std::invalid_argument("balls and necklaces must be of the same beads");
  mark(blocks);
  if (!fill_again(balls, blocks)) return std::nullopt;
  for (std::size_t level = 0; level + 1 < levels_.size(); ++level)
    for (std::size_t node = 0; node < levels_[level].size(); ++node)
      if (marks_[level + 1][node] != 0)
        kernels_.unite(levels_[level].data(), node, node + 1, levels_[level + 1].data());
  for (const std::uint32_t block : blocks) find_stretched(block > 0 ? block - 1 : 0, block + 1);
  most_candidates_ = most;
  only_marked_ = true;
  (void)search(balls, false);
  only_marked_ = false;
  counts_.candidates = candidate_count_;
  if (candidate_count_ > most) return std::nullopt;
  return std::span<const BeadPair>(candidates_.data(), candidate_count_);
}

template <int Dimension>
std::span<const double> BlockTree<Dimension>::strayed_by_block(const Balls<Dimension>& balls) {
  const FloatingPointGuard to_nearest;
  if (balls.size() != beads_) throw std::invalid_argument("balls and necklaces must be of the same beads");
  strays_.resize(boxes_.size());
  with_sources(balls, source_of(0, 0), [&](BlockSource<Dimension> some, std::size_t first, std::size_t last) {
    for (std::size_t block = first; block < last; ++block) {
      strays_[block] = frame_.farthest(kernels_.stray(some, block, block + 1, blocks()));
      for (const double*& axis : some.centers) axis += beads_in_block;
    }
  });
  return strays_;
}

template <int Dimension>
double BlockTree<Dimension>::strayed(const Balls<Dimension>& balls) {
  const FloatingPointGuard to_nearest;
  if (balls.size() != beads_) throw std::invalid_argument("balls and necklaces must be of the same beads");
  float farthest = 0;
  with_sources(balls, source_of(0, 0),
               [&](const BlockSource<Dimension>& some, std::size_t first, std::size_t last) {
                 farthest = std::max(farthest, kernels_.stray(some, first, last, blocks()));
               });
  return frame_.farthest(farthest);
}

template class BlockTree<2>;
template class BlockTree<3>;

}  // namespace kds
