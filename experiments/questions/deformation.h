#pragma once
// The energy of deforming a chain in the simplest model: springs of stiffness 1 at its angles. From one
// conformation to the next, the energy is half the sum of the squared changes, in radians, of all bending and
// torsion angles. A bending angle lies at a bead, between its two bonds. A torsion angle lies at a bond,
// between the bonds before and after it. Bond lengths do not count, and rigid motions take no energy.

#include <Eigen/Core>
#include <span>
#include <vector>

namespace kds {

struct Deformation {
  double bending = 0, torsion = 0;
  [[nodiscard]] double energy() const { return bending + torsion; }
};

/// Compares two conformations of one chain. An angle that is undefined, because three beads are collinear or
/// a bond has zero length, counts as unchanged.
[[nodiscard]] Deformation deformation(const Eigen::Matrix3Xd& before, const Eigen::Matrix3Xd& after);

/// A chain given by its angles: n beads, n - 2 bending angles (pi is straight), n - 3 torsion angles.
struct ChainAngles {
  std::vector<double> bending, torsion;
};
[[nodiscard]] Eigen::Matrix3Xd chain_of(const ChainAngles& angles, double bond);

}  // namespace kds
