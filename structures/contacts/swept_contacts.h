#pragma once
// Finds the contacts of a whole step by one traversal of chord cages (structures/chord_cages), within
// necklaces and between them. If the cages of two nodes stay apart during the step, the nodes have no
// contact. Otherwise the node with more beads is split first. A static sphere around each cage's path is
// tested before the cages themselves, at the cost of a test of two static spheres.
//
// Runs do not use this class, because the boxes of moving_family.h find the same pairs faster (`kds bench
// trade`).

#include <cstdint>
#include <vector>

#include "motions/curves/curves.h"
#include "structures/chord_cages/chord_cages.h"
#include "structures/necklace/bead_pairs.h"
#include "structures/necklace/necklace_tree.h"

namespace kds {

/// Pairs found, in no particular order.
struct FoundPairs {
  std::vector<BeadPair> pairs;
  std::uint64_t tests = 0;  ///< number of tests of two spheres of nodes or beads
};

template <int Dimension>
class SweptContacts {
 public:
  /// `tree` must have the same necklaces as `asked`.
  SweptContacts(const NecklaceTree& tree, PairsAsked asked);

  /// Finds the pairs of beads that meet at any time of the step of these linear curves, ends included, and no
  /// others. `start` and `end` are cages that hold the balls of their nodes exactly at both ends. Throws
  /// std::invalid_argument if the motion is not linear.
  void find(const OutwardCages<Dimension>& start, const OutwardCages<Dimension>& end,
            const Curves<Dimension>& curves, FoundPairs& found);
  /// Finds the pairs that meet at the k-th control points, at rest. Serves as the static query for
  /// comparison.
  void find_static(const OutwardCages<Dimension>& cages, const Curves<Dimension>& curves, int k,
                   FoundPairs& found);

 private:
  using Item = std::uint32_t;  ///< a node, or a bead numbered after the nodes

  template <class MayMeet>
  void traverse(const MayMeet& may_meet, FoundPairs& found);

  struct Children {
    Item left, right;
  };

  PairsAsked asked_;
  Item nodes_;
  std::vector<Item> roots_;  // for the necklaces
  std::vector<Children> children_;
  std::vector<BeadRange> ranges_;         // for items
  std::vector<Cage<Dimension>> resting_;  // static spheres around the paths of items
};

}  // namespace kds
