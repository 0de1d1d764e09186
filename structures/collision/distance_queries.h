#pragma once
// Answers distance queries with a block tree (block_tree.h): the closest pair, and all pairs within a cutoff.
//
// The search for the closest pair starts from a few offered pairs: the pairs that are least apart along their
// chain and the closest pair of the last call. The least distance of the offered pairs bounds the search. All
// pairs up to a gap are then found. The gap grows while it contains no pair, and shrinks while it contains
// too many. If this search fails, for huge numbers or for more equally close beads than memory should hold, a
// layered hierarchy is searched by branch and bound.
//
// The result is exact: all pairs up to the gap are found (float_conversion.h), and the closest of them is
// decided exactly. If its distance is within the gap, no other pair is closer.

#include <optional>
#include <vector>

#include "structures/collision/block_tree.h"
#include "structures/collision/closest_pair.h"

namespace kds {

template <int Dimension>
class DistanceQueries {
 public:
  /// Throws std::invalid_argument like BlockTree.
  explicit DistanceQueries(PairsAsked asked, VectorTarget target = widest_vector_target())
      : tree_(std::move(asked), std::nullopt, target) {}

  /// Returns the closest of the pairs asked about, or none if no pairs are asked about. If several are
  /// equally close, returns the first.
  [[nodiscard]] std::optional<ClosestPair> closest_pair(const Balls<Dimension>& balls);

  /// Returns all pairs asked about that are at most `distance` apart (finite, not negative), in order. The
  /// result is valid until the next call.
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
