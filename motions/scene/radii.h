#pragma once
// Bead radii of a run, by the policies of `--radius`.

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "motions/frames/trajectory.h"

namespace kds {

/// The longest bond of all frames, which come one after the other.
class LongestBond {
 public:
  /// A frame of one necklace; a chain break is no bond.
  void add(const Eigen::Ref<const Eigen::Matrix3Xd>& frame, const std::vector<std::size_t>& breaks);
  /// Half its length, rounded up so that its beads meet: the least double of which all consecutive beads do.
  /// Throws InputError where there is no such number above 0.
  [[nodiscard]] double radius() const;

 private:
  double longest_ = 0;  ///< rounded
  double radius_ = 0;
};

/// One radius a bead for all necklaces of a run, in scene order. `policy` is
///   auto          half the longest bond over all frames, chain breaks left out, rounded up so that its beads
///   meet; one radius for all beads of the run; a number      that radius for all (finite, positive); element
///   van der Waals radii; element:fit   the same scaled by one factor until nonadjacent beads are disjoint in
///   the first frame; file:PATH     one a line in bead order, or a single one for all (finite, not negative).
/// Throws InputError naming the option, file, line or bead. Of a necklace only the first frame need be there
/// where `bonds` tells of all of them.
[[nodiscard]] std::vector<double> bead_radii(const std::string& policy, std::span<const Trajectory> necklaces,
                                             const LongestBond& bonds);
/// The same of necklaces with all their frames.
[[nodiscard]] std::vector<double> bead_radii(const std::string& policy,
                                             std::span<const Trajectory> necklaces);

}  // namespace kds
