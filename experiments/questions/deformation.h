#pragma once
// How much energy it takes to deform a chain, in the simplest model of one: springs of stiffness 1 at its
// angles. From one conformation to the next the energy is half the sum of the squared changes, in radians, of
// all bending angles (at a bead, between its two bonds), and half that of all torsion angles (at a bond, of
// the bonds before and after it). Lengths of bonds do not count, rigid motion takes none.

#include <Eigen/Core>
#include <span>
#include <vector>

namespace kds {

struct Deformation {
  double bending = 0, torsion = 0;
  [[nodiscard]] double energy() const { return bending + torsion; }
};

/// Two conformations of one chain. Angles that three beads in a row or a bond of no length leave open count
/// as unchanged.
[[nodiscard]] Deformation deformation(const Eigen::Matrix3Xd& before, const Eigen::Matrix3Xd& after);

/// A chain by its angles: n beads, n - 2 bending angles (pi is straight), n - 3 torsion angles.
struct ChainAngles {
  std::vector<double> bending, torsion;
};
[[nodiscard]] Eigen::Matrix3Xd chain_of(const ChainAngles& angles, double bond);

}  // namespace kds
