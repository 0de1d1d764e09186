#pragma once
// Finds the pairs of moving balls that may meet in a step, for structures that then watch or test each pair.

#include "certificates/base/kernel.h"
#include "motions/curves/curves.h"
#include "structures/contacts/moving_family.h"
#include "structures/images/near_images.h"
#include "structures/images/shifted_beads.h"
#include "structures/necklace/bead_pairs.h"

namespace kds {

/// Uses a separating family (moving_family.h), or a uniform grid if the curves have a cell (near_images.h).
/// With the kernel `exact`, all pairs may meet, except that doubles exclude images that are out of reach.
template <int Dimension>
class NearBalls {
 public:
  using Resting = typename MovingFamily<Dimension>::Resting;

  NearBalls(const PairsAsked& asked, int degree) : family_(asked, degree), images_(asked) {}

  [[nodiscard]] const PairsAsked& asked() const { return family_.asked(); }
  /// Must be called before the first step.
  void forget_rest() { family_.forget_rest(); }
  /// Finds the pairs asked about for the step of these curves; call it once per step. Numbers new shifts in
  /// `shifts`. Costs as much as MovingFamily::find_pairs or NearImages::find, and with the kernel `exact` as
  /// much as listing all pairs.
  void find(const Curves<Dimension>& curves, Kernel kernel, Resting resting, bool list_overlapping,
            ShiftNumbers<Dimension>& shifts, PairsOfImages& found);
  /// Finds at least the pairs of these beads, after only their curves have changed since the last call in the
  /// same step. Takes no longer than `find`.
  void find_of(const Curves<Dimension>& curves, std::span<const BeadId> beads, Kernel kernel, Resting resting,
               bool list_overlapping, ShiftNumbers<Dimension>& shifts, PairsOfImages& found);

 private:
  MovingFamily<Dimension> family_;
  NearImages<Dimension> images_;  // in place of the family if there is a cell
  PairsOfBlocks of_blocks_;       // what the family finds
};

}  // namespace kds
