#pragma once
// Which beads a minimum enclosing sphere can lose during a step, without a certificate for each: beads of
// equal radii in linear motion.
//
// Let z(u) be the centre of the sphere of a basis, seen from its first bead, and z'(u) the *chord*, linear
// between two approximate centres. With d_i the other basis beads seen from the first, z solves
// d_i.z = |d_i|^2 / 2 (and n.z = 0 for a triangle of normal n), z' leaves residuals r_i of degree 2 (and 3),
// and |z - z'| <= B follows from Bernstein bounds of the residuals and a lower one of the determinant. The
// radius is |z| >= |z'| - B, and |z'| stays above its own chord less |z'(1) - z'(0)|^2 / (8 min |z'|). A bead
// moves linearly too, so its distance from the chord is convex: if at both ends it is at most
//   limit = |z'| - 2B - |z'(1) - z'(0)|^2 / (8 min |z'|),
// the bead is inside all the time. All in double, with margins far above its rounding: what is proved here
// holds; what is not needs a certificate.

#include <Eigen/Core>
#include <array>
#include <vector>

#include "motions/bead_range.h"
#include "motions/bezier_motion.h"
#include "structures/basis.h"

namespace kds {

/// Centres at both ends of a step, a column a coordinate.
class StepEnds {
 public:
  template <Motion M>
  void set(const M& motion) {
    static_assert(M::dimension == 3 && M::degree == 1);
    for (int end = 0; end < 2; ++end) {
      for (int axis = 0; axis < 3; ++axis) {
        auto& column = columns_[static_cast<std::size_t>(3 * end + axis)];
        column.resize(motion.bead_count() + 3);  // read four at a time
        for (BeadId b = 0; b < motion.bead_count(); ++b) column[b] = motion.coordinate(b, end, axis);
      }
    }
    measure();
  }
  [[nodiscard]] Eigen::Vector3d center(BeadId bead, int end) const {
    const auto e = static_cast<std::size_t>(3 * end);
    return {columns_[e][bead], columns_[e + 1][bead], columns_[e + 2][bead]};
  }
  [[nodiscard]] const double* column(int end, int axis) const {
    return columns_[static_cast<std::size_t>(3 * end + axis)].data();
  }
  /// No coordinate difference at one end is larger.
  [[nodiscard]] double extent() const { return extent_; }

 private:
  void measure();
  std::array<std::vector<double>, 6> columns_;
  double extent_ = 0;
};

struct SphereChord {
  bool proved = false;       ///< else nothing is known of the sphere
  bool keeps_basis = false;  ///< no basis bead comes inside the sphere of the others
  std::array<Eigen::Vector3d, 2> center{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  std::array<double, 2> limit{};
};

/// From time `from` to the end of the step, of a basis of two to four beads.
[[nodiscard]] SphereChord sphere_chord(const StepEnds& ends, const Basis& basis, double from);

/// Sets `beyond` to the beads of a range that are not proved to stay inside, basis beads among them.
void find_beyond(const StepEnds& ends, const BeadRange& range, BeadId base, const SphereChord& chord,
                 double from, std::vector<BeadId>& beyond);

}  // namespace kds
