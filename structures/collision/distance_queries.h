#pragma once
// Distance queries by a block tree (block_tree.h): the closest pair, and the pairs within a cutoff.
//
// For the closest pair some pairs are offered first, those that are least apart along their chain and the one
// that was closest at the last call: no pair that is farther apart than the closest of them need be looked
// at. All pairs up to a gap are found, and the gap is made wider as long as none of them is within it,
// narrower where they are too many. Where it comes to nothing, as for huge numbers or for more beads
// equally far apart than memory should hold, a layered hierarchy is searched by branch and bound.
//
// Exact, as the pairs up to a gap are all there (float_frame.h), and the closest of those offered is decided
// exactly: if it is within the gap no other pair is closer.

#include <optional>
#include <vector>

#include "structures/collision/block_tree.h"
#include "structures/collision/closest_so_far.h"

namespace kds {

template <int Dimension>
class DistanceQueries {
 public:
  /// Throws std::invalid_argument as BlockTree does.
  explicit DistanceQueries(PairsAsked asked, VectorTarget target = widest_vector_target())
      : tree_(std::move(asked), std::nullopt, target) {}

  /// The closest of the pairs asked about, of several equally close the first; none if none are asked about.
  [[nodiscard]] std::optional<ClosestPair> closest_pair(const Balls<Dimension>& balls);

  /// All pairs asked about that are at most so far apart (finite, not negative), in order. Valid until the
  /// next call.
  const std::vector<BeadPair>& pairs_within(const Balls<Dimension>& balls, double distance);

 private:
  void offer_some(ClosestSoFar<Dimension>& closest) const;
  [[nodiscard]] bool search(const Balls<Dimension>& balls, double largest_radius,
                            ClosestSoFar<Dimension>& closest);

  BlockTree<Dimension> tree_;
  std::optional<BeadPair> closest_before_;
  std::vector<BeadPair> pairs_;
  PairSorter sorter_;
};

}  // namespace kds
