#pragma once
// Near pairs kept from frame to frame, by gap: while no bead has moved by more than d since they were found,
// only pairs at most 2 d apart then can meet now, and only these are looked at. In slow motion that is few,
// and a frame costs little more than reading where the beads are.
//
// Where only some beads have gone far, their pairs are replaced and all others stay.
//
// Exact: gaps are rounded down. A gap is computed from coordinates times a power of two, with an error below
// 2^-49 of distance and reach, and counts less by 2^-46 of them.

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
  /// Keeps these: all pairs that are at most `skin` apart, and maybe others. `frame` is the scene's.
  void keep(const Balls<Dimension>& balls, std::span<const BeadPair> near, double skin,
            const FloatFrame<Dimension>& frame);
  /// Pairs with a marked bead (a mark that is not zero for each bead) are taken out for these: all pairs with
  /// such a bead that are at most the skin apart, marked beads where they are now, the others where they were
  /// when their pairs were found, and maybe others. From now on a marked bead was where it is now. `moved`:
  /// no bead without a mark is farther from where it was.
  void replace(const Balls<Dimension>& balls, std::span<const unsigned char> marks,
               std::span<const BeadPair> near, double moved);

  [[nodiscard]] double skin() const { return skin_; }
  [[nodiscard]] std::size_t size() const { return pairs_.size(); }

  /// All pairs that meet, in order, where no bead is farther than `moved` from where it was: at most half the
  /// skin.
  void find_meeting(const Balls<Dimension>& balls, double moved, std::vector<BeadPair>& meeting);
  /// How many pairs that looked at, so far.
  [[nodiscard]] std::size_t looked_at() const { return looked_at_; }

 private:
  static constexpr std::size_t classes = 16;  // by gap, each as wide as skin / classes
  double skin_ = 0, scale_ = 1;
  std::vector<BeadPair> pairs_, more_pairs_;  // class by class, the first in order
  std::array<std::size_t, classes + 1> starts_{};
  std::vector<unsigned char> class_of_;
  std::vector<BeadPair> first_class_;
  PairSorter sorter_;
  std::size_t looked_at_ = 0;
};

}  // namespace kds
