#pragma once
// The same chains by one bead a residue, its CA: another model of them, as a run with --select ca has it.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "experiments/trade/match_contacts.h"
#include "motions/base/bead_range.h"
#include "motions/frames/trajectory.h"

namespace kds {

struct CalphaModel {
  std::vector<Trajectory> necklaces;
  std::vector<BeadRange> ranges;  ///< of its beads, one a necklace
  std::vector<double> radii;
  /// A ball of it around a CA holds the balls of its residue, at all times: in three decimals, rounded up. 0:
  /// there is none, as numbers are too large or too small.
  double covering_radius = 0;
  // In the finest data, of each of its beads:
  std::vector<BeadId> bead;
  std::vector<BeadRange> residue;    ///< all that stands for
  std::vector<BeadId> of_bead = {};  ///< the other way: whose residue each bead of the finest data is in

  /// Beads of the finest data in the residue that has most.
  [[nodiscard]] BeadId largest_residue() const;
  /// Contacts of beads as contacts of their residues: those of pairs that the model asks about, by pairs,
  /// then in the order of time.
  [[nodiscard]] std::vector<ContactTime> of_residues(const std::vector<ContactTime>& contacts,
                                                     BeadId apart) const;
};

/// None where some bead's residue is not known or has no CA, there are no other beads, or fewer than four
/// residues. `radius` is the policy by which the beads of `necklaces` have got their `radii`.
[[nodiscard]] std::optional<CalphaModel> calpha_model(std::span<const Trajectory> necklaces,
                                                      std::span<const double> radii,
                                                      const std::string& radius);

}  // namespace kds
