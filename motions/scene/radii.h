#pragma once
// The bead radii of a run, by the policies of `--radius`.

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "motions/frames/trajectory.h"

namespace kds {

/// Finds the longest bond of all frames, which are added one after the other.
class LongestBond {
 public:
  /// Adds a frame of one necklace. A chain break does not count as a bond.
  void add(const Eigen::Ref<const Eigen::Matrix3Xd>& frame, const std::vector<std::size_t>& breaks);
  /// Returns half the length of the longest bond, rounded up to the smallest double with which all
  /// consecutive beads meet. Throws InputError if there is no such number above 0.
  [[nodiscard]] double radius() const;

 private:
  double longest_ = 0;  ///< rounded
  double radius_ = 0;
};

/// Returns one radius per bead for all necklaces of a run, in scene order. `policy` is one of
/// - auto: half the longest bond over all frames without chain breaks, rounded up so that its beads meet; one
///   radius for all beads of the run
/// - a number: that radius for all beads (finite, positive)
/// - element: van der Waals radii
/// - element:fit: van der Waals radii times one factor such that nonadjacent beads are disjoint in the first
///   frame
/// - file:PATH: one radius per line in bead order, or a single one for all beads (finite, not negative)
///
/// Throws InputError naming the option, file, line or bead. `bonds` must cover all frames; the necklaces need
/// to hold only their first frames.
[[nodiscard]] std::vector<double> bead_radii(const std::string& policy, std::span<const Trajectory> necklaces,
                                             const LongestBond& bonds);
/// Does the same for necklaces that hold all their frames.
[[nodiscard]] std::vector<double> bead_radii(const std::string& policy,
                                             std::span<const Trajectory> necklaces);

}  // namespace kds
