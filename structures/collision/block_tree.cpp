#include "structures/collision/block_tree.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <span>
#include <stdexcept>

#include "motions/base/floating_point_scope.h"
#include "motions/base/interruption.h"
#include "structures/blocks/float_conversion.h"

namespace kds {

namespace {

constexpr std::size_t sample_stride = 8;

// Returns the cost of a search in comparisons of four beads with four, about 2 ns each.
template <class Counts>
double work_of(const Counts& counts) {
  return 10.0 * static_cast<double>(counts.node_pairs) + 1.5 * static_cast<double>(counts.block_pairs) +
         static_cast<double>(counts.group_pairs);
}
// Cost per block, in these units, of sorting and searching sorted beads, and of turning boxes and searching
// in them.
constexpr double work_of_sorted_block = 230, work_of_turned_block = 45;
constexpr std::size_t fewest_beads_to_choose = 2000;

// If the scene exceeds the cache, a pair is prefetched this many pairs before it is compared.
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
    : wanted_(order),
      loops_(block_loops<Dimension>(target)),
      blocks_(std::move(asked), loops_, order.value_or(BlockOrder::sequence)) {
  groups_.resize(16 * block_pairs_at_once + loop_padding);
  near_groups_.resize(groups_.size());
  near_beads_.resize(groups_.size());
}

// Returns whether any pair of the nodes' beads may be asked about. The nodes belong to levels()[level], and
// a <= b.
template <int Dimension>
bool BlockTree<Dimension>::asks(std::uint32_t a, std::uint32_t b, std::size_t level) const {
  if (blocks_.order() == BlockOrder::spatial) return true;
  const std::size_t width = children_of_node << (4 * level), blocks = blocks_.size();
  const std::size_t first = a * width, last = std::min((b + 1) * width, blocks) - 1;
  const auto all_rest = [&](std::uint32_t node) {
    std::size_t n = blocks_.necklaces()[node * width];
    const std::size_t end = blocks_.necklaces()[std::min((node + 1) * width, blocks) - 1];
    while (n <= end && asked().rests(n)) ++n;
    return n > end;
  };
  if (!asked().at_rest.empty() && all_rest(a) && all_rest(b)) return false;
  if (!asked().between &&
      blocks_.necklaces()[std::min((a + 1) * width, blocks) - 1] < blocks_.necklaces()[b * width])
    return false;
  if (blocks_.necklaces()[first] != blocks_.necklaces()[last]) return true;
  return asked().within && (last - first + 1) * beads_in_block > asked().apart;
}

// `marks` belong to the level below levels()[level]: blocks or nodes.
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
  for (std::size_t level = blocks_.levels().size() - 1; level > 0; --level) {
    more_nodes_.count = 0;
    for (std::size_t k = 0; k < nodes_.count; ++k) {
      const std::uint32_t a = nodes_.first[k], b = nodes_.second[k];
      if (!asks(a, b, level)) continue;
      more_nodes_.reserve(children_of_node * children_of_node);
      const std::size_t before = more_nodes_.count;
      more_nodes_.count += loops_.expand(blocks_.levels()[level].data(), a, b, 0, more_nodes_.end());
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
    InterruptionCheck::ask();
    const std::uint32_t a = nodes_.first[k], b = nodes_.second[k];
    fetch(blocks_.levels()[0][nodes_.second[std::min(k + fetched_ahead, nodes_.count - 1)]]);
    if (candidate_count_ > most_candidates_ || !asks(a, b, 0)) return;
    block_pairs_.reserve(children_of_node * children_of_node);
    const std::size_t before = block_pairs_.count;
    block_pairs_.count +=
        loops_.expand(blocks_.levels()[0].data(), a, b, blocks_.stretched()[a], block_pairs_.end());
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
    const double work_a_block = work / static_cast<double>(blocks_.size());
    if (may_turn_ && work_a_block > work_of_turned_block) {
      may_turn_ = false;
      bond_axes_ = bond_axes(balls, blocks_.conversion().scale);
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

// Compares beads that are near along the chain. Boxes of consecutive groups always meet, so all these pairs
// are compared in sequence here and are left out when groups are compared.
template <int Dimension>
void BlockTree<Dimension>::compare_along() {
  if (!blocks_.goes_along()) return;
  if (!only_marked_) return compare_along(0, blocks_.size());
  // A block's beads are also the second beads of pairs that begin in the block before.
  std::size_t done = 0;
  for (const std::uint32_t block : marked_blocks_) {
    compare_along(std::max<std::size_t>(done, block > 0 ? block - 1 : 0), block + 1);
    done = block + 1;
  }
}

template <int Dimension>
void BlockTree<Dimension>::compare_along(std::size_t first, std::size_t last) {
  const auto loop = blocks_.equal_radii() ? loops_.along_equal : loops_.along_unequal;
  constexpr std::size_t at_once = 2 * block_pairs_at_once;  // a block gives at most eight results
  for (; first < last; first += at_once) {
    const std::size_t near =
        loop(blocks_.view(), first, std::min(first + at_once, last), blocks_.stretched().data(),
             asked().apart, blocks_.limit(), {near_groups_.data(), near_beads_.data()});
    reserve_candidates(near);
    for (std::size_t k = 0; k < near; ++k) {
      const std::uint32_t block = near_groups_[k] / 8, along = near_groups_[k] % 8;
      if (asked().rests(blocks_.necklaces()[block])) continue;
      const BeadId end = asked().necklaces[blocks_.necklaces()[block]].last;
      for (unsigned bits = near_beads_[k]; bits != 0; bits &= bits - 1) {
        const BeadId bead = blocks_.first_bead(block) + static_cast<BeadId>(std::countr_zero(bits));
        if (end - bead < along) continue;  // the second bead is in the next necklace
        if (only_marked_ && (marked_beads_[bead] | marked_beads_[bead + along]) == 0) continue;
        candidates_[candidate_count_++] = {bead, bead + along};
      }
    }
  }
}

template <int Dimension>
void BlockTree<Dimension>::compare_blocks() {
  const auto loop = blocks_.equal_radii() ? loops_.compare_equal : loops_.compare_unequal;
  const bool sequence = blocks_.order() == BlockOrder::sequence;
  const bool one_necklace = asked().necklaces.size() == 1 && asked().at_rest.empty();
  const LanesAsked lanes{blocks_.necklaces().data(), sequence ? asked().apart : 1,
                         !sequence || asked().within, !sequence || asked().between, blocks_.goes_along()};
  counts_.block_pairs += block_pairs_.count;
  for (std::size_t from = 0; from < block_pairs_.count; from += block_pairs_at_once) {
    const std::size_t count = std::min(block_pairs_at_once, block_pairs_.count - from);
    const NodePairs some{block_pairs_.first.data() + from, block_pairs_.second.data() + from};
    const std::size_t near = loop(blocks_.view(), some, count, lanes, blocks_.limit(), groups_.data(),
                                  {near_groups_.data(), near_beads_.data()}, counts_.group_pairs);
    reserve_candidates(near);
    for (std::size_t k = 0; k < near; ++k) {
      const std::uint32_t group = near_groups_[k];
      const std::uint32_t a = some.first[group / 16], b = some.second[group / 16];
      const std::size_t g = group / 4 % 4, h = group % 4;
      if (sequence && asked().rests(blocks_.necklaces()[a]) && asked().rests(blocks_.necklaces()[b]))
        continue;
      for (unsigned bits = near_beads_[k]; bits != 0; bits &= bits - 1) {
        const auto bit = static_cast<std::size_t>(std::countr_zero(bits));
        BeadPair pair{blocks_.bead_at(a, 4 * g + bit / 4), blocks_.bead_at(b, 4 * h + bit % 4)};
        if (!sequence) {
          if (pair.second < pair.first) std::swap(pair.first, pair.second);
          const bool is_asked =
              one_necklace ? asked().within && pair.second - pair.first >= asked().apart : asked().asks(pair);
          if (!is_asked) continue;
        }
        candidates_[candidate_count_++] = pair;
      }
    }
  }
  block_pairs_.count = 0;
}

template <int Dimension>
void BlockTree<Dimension>::choose_anew() {
  searches_since_choice_ = 0;
  may_turn_ = true;
  blocks_.turn(std::nullopt);
  if (!wanted_ && blocks_.order() == BlockOrder::spatial) blocks_.arrange(BlockOrder::sequence);
}

template <int Dimension>
void BlockTree<Dimension>::find_candidates(const Balls<Dimension>& balls, double gap, std::size_t most) {
  most_candidates_ = most;
  if (balls.size() != bead_count())
    throw std::invalid_argument("balls and necklaces must be of the same beads");
  counts_ = {};
  candidate_count_ = 0;
  if (bead_count() == 0) return;
  if (searches_since_choice_++ >= most_searches_as_chosen) choose_anew();
  const bool may_choose = !wanted_ && bead_count() >= fewest_beads_to_choose;
  while (true) {
    blocks_.fill(balls, gap);
    const Outcome outcome = search(balls, may_choose && blocks_.order() == BlockOrder::sequence);
    if (outcome == Outcome::found) break;
    searches_since_choice_ = 0;
    if (outcome == Outcome::better_turned) {
      blocks_.turn(*bond_axes_);
    } else {
      blocks_.turn(std::nullopt);
      blocks_.arrange(BlockOrder::spatial);
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
  const FloatingPointScope to_nearest;
  find_candidates(balls, 0, most);
  if (candidate_count_ > most) return nullptr;
  pairs_.clear();
  for (std::size_t k = 0; k < candidate_count_; ++k)
    if (balls_meet(balls, candidates_[k].first, candidates_[k].second)) pairs_.push_back(candidates_[k]);
  sorter_.sort(pairs_, bead_count());
  return &pairs_;
}

template <int Dimension>
std::optional<std::span<const BeadPair>> BlockTree<Dimension>::near_pairs(const Balls<Dimension>& balls,
                                                                          double gap, std::size_t most) {
  const FloatingPointScope to_nearest;
  find_candidates(balls, gap, most);
  if (candidate_count_ > most) return std::nullopt;
  return std::span<const BeadPair>(candidates_.data(), candidate_count_);
}

template <int Dimension>
void BlockTree<Dimension>::mark(std::span<const std::uint32_t> blocks) {
  marked_blocks_.assign(blocks.begin(), blocks.end());
  marks_.resize(blocks_.levels().size());
  marks_[0].assign(blocks_.size(), 0);
  for (std::size_t level = 1; level < marks_.size(); ++level)
    marks_[level].assign(blocks_.levels()[level - 1].size(), 0);
  marked_beads_.assign(bead_count(), 0);
  for (const std::uint32_t block : blocks) {
    for (std::size_t k = 0, count = blocks_.beads_of(block); k < count; ++k)
      marked_beads_[blocks_.bead_at(block, k)] = 1;
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
  const FloatingPointScope to_nearest;
  if (balls.size() != bead_count())
    throw std::invalid_argument("balls and necklaces must be of the same beads");
  mark(blocks);
  if (!blocks_.fill_again(balls, blocks)) return std::nullopt;
  for (std::size_t level = 0; level + 1 < blocks_.levels().size(); ++level)
    for (std::size_t node = 0; node < blocks_.levels()[level].size(); ++node)
      if (marks_[level + 1][node] != 0) blocks_.unite(level, node);
  most_candidates_ = most;
  only_marked_ = true;
  (void)search(balls, false);
  only_marked_ = false;
  counts_.candidates = candidate_count_;
  if (candidate_count_ > most) return std::nullopt;
  return std::span<const BeadPair>(candidates_.data(), candidate_count_);
}

template class BlockTree<2>;
template class BlockTree<3>;

}  // namespace kds
