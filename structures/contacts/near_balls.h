#pragma once
// Finds the pairs of moving balls that may meet in a step, for structures that then watch or test each pair.

#include "certificates/base/kernel.h"
#include "motions/curves/curves.h"
#include "structures/contacts/moving_family.h"
#include "structures/images/near_images.h"
#include "structures/images/shifted_beads.h"
#include "structures/necklace/bead_pairs.h"
#include "structures/necklace/pairs_in_question.h"

namespace kds {

/// Uses a separating family (moving_family.h), or a uniform grid if the curves have a cell (near_images.h).
/// With the kernel `exact`, all pairs may meet, except that doubles exclude images that are out of reach.
template <int Dimension>
class NearBalls {
 public:
  using Resting = typename MovingFamily<Dimension>::Resting;

  NearBalls(const PairsAsked& asked, int degree) : family_(asked, degree), images_(asked) {}

  [[nodiscard]] const PairsAsked& asked() const { return family_.asked(); }
  /// Must be called before a first step, which has no step before it.
  void forget_rest() { family_.forget_rest(); }
  /// Finds the pairs asked about for the step of these curves; call it once per step. New shifts get numbers.
  void find(const Curves<Dimension>& curves, Kernel kernel, Resting resting, bool list_overlapping,
            ShiftNumbers<Dimension>& shifts, PairsOfImages& found) {
    if (curves.cell() != nullptr) {
      if (kernel == Kernel::exact) {
        images_.find_by_boxes(curves, shifts, found);
      } else {
        images_.find(curves, list_overlapping, shifts, found);
      }
      return;
    }
    found.clear();
    if (kernel == Kernel::exact) {
      PairsInQuestion(family_.asked()).for_each([&](BeadId i, BeadId j) {
        found.unclear.push_back({{i, j}});
      });
      return;
    }
    family_.find_pairs(curves, resting, list_overlapping, of_blocks_);
    for (const BeadPair& pair : of_blocks_.unclear) found.unclear.push_back({pair});
    for (const BeadPair& pair : of_blocks_.overlapping) found.overlapping.push_back({pair});
    found.proved = family_.size() + of_blocks_.proved_apart;
  }

 private:
  MovingFamily<Dimension> family_;
  NearImages<Dimension> images_;  // in place of the family if there is a cell
  PairsOfBlocks of_blocks_;       // what the family finds
};

}  // namespace kds
