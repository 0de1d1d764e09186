#pragma once
// A coarser model of the same chains with one bead per residue, its CA. A run with --select ca uses the same
// beads.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "experiments/trade/match_events.h"
#include "motions/base/bead.h"
#include "motions/frames/trajectory.h"

namespace kds {

struct CalphaModel {
  std::vector<Trajectory> necklaces;
  std::vector<BeadRange> ranges;  ///< the model's beads of each necklace
  std::vector<double> radii;
  /// The radius at which a ball around a CA always contains all balls of its residue. The radius is rounded
  /// up to three digits. 0 if no such radius exists because numbers are too large or too small.
  double covering_radius = 0;
  // For each bead of the model, in the numbering of the finest data:
  std::vector<BeadId> bead;
  std::vector<BeadRange> residue;  ///< the beads of its residue
  /// The inverse: for each bead of the finest data, the model's bead of its residue.
  std::vector<BeadId> of_bead = {};

  /// Returns the largest number of beads (of the finest data) in a residue.
  [[nodiscard]] BeadId largest_residue() const;
  /// Turns contacts of beads into contacts of their residues. Keeps the pairs that the model asks about.
  /// Sorts by pair, then by time.
  [[nodiscard]] std::vector<ContactTime> of_residues(const std::vector<ContactTime>& contacts,
                                                     BeadId apart) const;
};

/// Returns the model. Returns nothing in these cases: the residue of a bead is unknown or has no CA, every
/// bead is a CA, or there are fewer than four residues. `radius` is the policy that gave the beads of
/// `necklaces` their `radii`.
[[nodiscard]] std::optional<CalphaModel> calpha_model(std::span<const Trajectory> necklaces,
                                                      std::span<const double> radii,
                                                      const std::string& radius);

}  // namespace kds
