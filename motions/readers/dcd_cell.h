#pragma once
// The six numbers of a DCD frame's unit cell.
//
// Programs write them in three forms:
//   degrees       a, gamma, b, beta, alpha, c         CHARMM before 22, OpenMM, MDTraj
//   cosines       the same with cosines of the angles NAMD, VMD, LAMMPS
//   shape matrix  xx, xy, yy, xz, yz, zz              CHARMM from 22 on (symmetric, positive definite)
//
// No flag distinguishes the forms. Each frame examined rules out the forms in which its numbers are not a
// cell. Degrees outside 20 to 160 are ruled out too, because no program simulates such cells. The header's
// title and version decide between the remaining forms:
//   1. An angle of exactly 60, 90 or 120 shows degrees.
//   2. Versions from 25 on, and titles of CHARMM (their lines begin with '*') from 22 on, show a matrix.
//   3. Versions below 22, and titles of NAMD, VMD, LAMMPS, OpenMM, MDTraj and MDAnalysis, rule out a matrix.
//   4. Numbers from -1 to 1 are cosines: the matrix of a cell that skew has larger ones.
// A cell that can still be both degrees and a matrix is not used.

#include <array>
#include <string>
#include <string_view>

#include "motions/frames/periodic.h"

namespace kds {

class DcdCellForm {
 public:
  using Numbers = std::array<double, 6>;

  DcdCellForm(int version, std::string_view title);

  /// Rules out forms. A rectangular cell has the same numbers as cosines and as a matrix, so it rules out
  /// only degrees.
  void look_at(const Numbers& numbers);
  /// Returns the cell in the remaining form.
  [[nodiscard]] CellRead read(const Numbers& numbers) const;

 private:
  int version_;
  bool by_charmm_, by_others_;
  bool degrees_ = true, cosines_ = true, matrix_ = true;
  bool exact_angle_ = false;
};

}  // namespace kds
