#pragma once
// The contacts of a whole step by one traversal of chord cages (structures/chord_cages), of a necklace with
// itself and of necklaces with each other: two nodes whose cages stay apart all over the step have no contact
// in it, others are opened, the one of more beads first. Cages at rest around each node's way come before
// the cages themselves: a look at two of these costs what one at two static spheres does.
//
// Runs do not use it: the boxes of blocks of moving_family.h find the same pairs faster (`kds bench trade`).

#include <cstdint>
#include <span>
#include <vector>

#include "motions/curves/curves.h"
#include "structures/chord_cages/outward_cages.h"
#include "structures/collision/pairs_asked.h"
#include "structures/necklace/necklace_tree.h"

namespace kds {

/// Pairs that are found, in no order.
struct FoundPairs {
  std::vector<BeadPair> pairs;
  std::uint64_t tests = 0;  ///< of two spheres: nodes, beads or both
};

template <int Dimension>
class SweptContacts {
 public:
  /// `tree`: of the same necklaces.
  SweptContacts(const NecklaceTree& tree, PairsAsked asked);

  /// Pairs of beads that meet at any time of the step of these linear curves, the ends included, and no
  /// others. `start`, `end`: cages that hold the balls of their nodes at both, exactly. Throws
  /// std::invalid_argument where the motion is not linear.
  void find(const OutwardCages<Dimension>& start, const OutwardCages<Dimension>& end,
            const Curves<Dimension>& curves, FoundPairs& found);
  /// The same at rest at the k-th control points: the static query to measure it by.
  void find_static(const OutwardCages<Dimension>& cages, const Curves<Dimension>& curves, int k,
                   FoundPairs& found);

 private:
  using Item = std::uint32_t;  ///< a node, or a bead, counted on from the nodes

  template <class MayMeet>
  void traverse(const MayMeet& may_meet, FoundPairs& found);

  struct Children {
    Item left, right;
  };

  PairsAsked asked_;
  Item nodes_;
  std::vector<Item> roots_;  // of the necklaces
  std::vector<Children> children_;
  std::vector<BeadRange> ranges_;         // of items
  std::vector<Cage<Dimension>> resting_;  // of items, around their ways
};

}  // namespace kds
