#pragma once
// The bonds of a scene's chains, and the balls around them: two bonds can meet only while their balls meet.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "motions/curves/motion_ref.h"
#include "motions/scene/scene.h"
#include "structures/necklace/bead_pairs.h"

namespace kds {

/// Bonds are numbered along the chains.
struct ChainBonds {
  std::vector<BeadId> first_beads;  ///< of each bond, ascending; the second bead follows the first
  PairsAsked pairs;                 ///< pairs of bonds that share no bead and of which one moves

  explicit ChainBonds(const Scene& scene) : first_beads(scene.bonds()) {
    // Bonds that follow each other share a bead, so a run of them is like a necklace of bonds.
    const PairsAsked beads{scene.necklaces()};
    for (BeadId bond = 0; bond < first_beads.size(); ++bond) {
      const BeadId bead = first_beads[bond];
      if (bond > 0 && bead == first_beads[bond - 1] + 1) {
        pairs.necklaces.back().last = bond;
        continue;
      }
      pairs.necklaces.push_back({bond, bond});
      if (!scene.at_rest().empty()) pairs.at_rest.push_back(scene.at_rest()[beads.necklace_of(bead)]);
    }
  }
};

/// Balls around the bonds of another motion, which must outlive it. A ball moves with its bond's midpoint and
/// contains the bond at all times; radii are rounded up.
class BondBalls {
 public:
  static constexpr int dimension = 3;
  static constexpr int degree = any_degree;

  BondBalls(const MotionRef<3>& motion, const std::vector<BeadId>& bonds)
      : motion_(motion), bonds_(bonds), row_(static_cast<std::size_t>(motion.degree()) + 1) {
    points_.resize(bonds.size() * row_ * stride);
    radii_.resize(bonds.size() * row_);
  }

  /// Computes the balls of the motion's present step.
  void move_to_step() {
    const Curves<3> curves = motion_.curves();
    for (std::size_t bond = 0; bond < bonds_.size(); ++bond) {
      const BeadId bead = bonds_[bond];
      double* const points = &points_[bond * row_ * stride];
      double reach = 0, largest = 0;
      for (std::size_t k = 0; k < row_; ++k) {
        const double* const p = curves.control_point(bead, static_cast<int>(k));
        const double* const q = curves.control_point(bead + 1, static_cast<int>(k));
        for (std::size_t axis = 0; axis < 3; ++axis) {
          points[k * stride + axis] = 0.5 * p[axis] + 0.5 * q[axis];
          largest = std::max({largest, std::abs(p[axis]), std::abs(q[axis])});
        }
        reach = std::max(reach, std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]));
      }
      // A bond is as long as one of its control points at most. The margin exceeds all rounding errors by
      // far.
      const double radius = 0.5 * reach + 0x1p-46 * largest + 0x1p-1000;
      for (std::size_t k = 0; k < row_; ++k) radii_[bond * row_ + k] = radius;
    }
  }

  [[nodiscard]] int own_degree() const { return static_cast<int>(row_) - 1; }
  [[nodiscard]] std::size_t bead_count() const { return bonds_.size(); }
  [[nodiscard]] const double* control_point(BeadId bond, int k) const {
    return &points_[(bond * row_ + static_cast<std::size_t>(k)) * stride];
  }
  [[nodiscard]] double coordinate(BeadId bond, int k, int axis) const { return control_point(bond, k)[axis]; }
  [[nodiscard]] double weight(BeadId bond, int k) const { return control_point(bond, k)[dimension]; }
  [[nodiscard]] const double* radii(BeadId bond) const { return &radii_[bond * row_]; }
  [[nodiscard]] double radius(BeadId bond, int k) const { return radii(bond)[k]; }
  [[nodiscard]] const double* cell() const { return motion_.curves().cell(); }

 private:
  static constexpr std::size_t stride = dimension + 1;  // the coordinates, then a weight of zero

  MotionRef<3> motion_;
  const std::vector<BeadId>& bonds_;
  std::size_t row_;  // control points of a curve
  std::vector<double> points_, radii_;
};

static_assert(Motion<BondBalls> && HasCell<BondBalls>);

}  // namespace kds
