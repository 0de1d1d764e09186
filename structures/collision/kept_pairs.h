#pragma once
// Keeps near pairs from frame to frame, sorted by gap. While no bead has moved by more than d since the pairs
// were found, only pairs that were at most 2 d apart then can meet now. Only these pairs are tested. In slow
// motion they are few, and a frame costs little more than reading the positions of the beads.
//
// If only some beads have moved far, their pairs are replaced and all others stay.
//
// The result is exact because gaps are rounded down. A gap is computed from coordinates times a power of two,
// with an error below 2^-49 of the sum of distance and reach. The stored gap is less by 2^-46 of this sum.

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "structures/blocks/float_frame.h"
#include "structures/collision/balls_meet.h"

namespace kds {

template <int Dimension>
class KeptPairs {
 public:
  /// Keeps the pairs `near`: all pairs that are at most `skin` apart, and possibly others. `frame` is the
  /// scene's float frame.
  void keep(const Balls<Dimension>& balls, std::span<const BeadPair> near, double skin,
            const FloatFrame<Dimension>& frame);
  /// Replaces the pairs with a marked bead; `marks` holds a nonzero mark for each such bead. `near` contains
  /// all pairs with a marked bead that are at most the skin apart, and possibly others. Distances there count
  /// marked beads at their present positions, and other beads where their pairs were found. A marked bead's
  /// reference position becomes its present one. No unmarked bead is farther than `moved` from its reference
  /// position.
  void replace(const Balls<Dimension>& balls, std::span<const unsigned char> marks,
               std::span<const BeadPair> near, double moved);

  [[nodiscard]] double skin() const { return skin_; }
  [[nodiscard]] std::size_t size() const { return pairs_.size(); }

  /// Finds all pairs that meet, in order. No bead may be farther than `moved` from its reference position,
  /// and `moved` is at most half the skin.
  void find_meeting(const Balls<Dimension>& balls, double moved, std::vector<BeadPair>& meeting);
  /// Returns how many pairs find_meeting has tested so far.
  [[nodiscard]] std::size_t looked_at() const { return looked_at_; }

 private:
  static constexpr std::size_t classes = 16;  // classes of gaps, each as wide as skin / classes
  double skin_ = 0, scale_ = 1;
  std::vector<BeadPair> pairs_, more_pairs_;  // class by class; the first class is in order
  std::array<std::size_t, classes + 1> starts_{};
  std::vector<unsigned char> class_of_;
  std::vector<BeadPair> first_class_;
  PairSorter sorter_;
  std::size_t looked_at_ = 0;
};

}  // namespace kds
