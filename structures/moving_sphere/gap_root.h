#pragma once
// Finds the time at which a ball crosses the sphere of a basis in linear motion, proved in double without the
// polynomials of the radical certificate (ball_in_sphere.h), whose degree is 10 to 12. For balls of unequal
// radii, in the plane and in space.
//
// The search is an interval subdivision with monotonicity tests. In a part of the step, the gap between ball
// and sphere (gap_bounds.h) may be known to have a sign, or to rise or fall. If it falls or rises, its signs
// at both ends tell whether it has a root there, which is then simple and the only one. Four parts are tested
// at once, and undecided parts are subdivided again. A root is estimated by the polynomial through the gap at
// five times, or by the chord, and then bracketed between two of four times around it whose signs are
// certain. The norm is also proved to have only this root in the bracket.

#include <optional>

#include "certificates/base/failure_time.h"
#include "structures/moving_sphere/sphere_enclosure.h"

namespace kds {

template <int Dimension>
class GapRoots {
 public:
  /// Returns, if doubles prove it, when the certificate that `bead` is inside the sphere of `basis` (outside,
  /// unless `inside`) first fails after a time in [lower, upper]. `holds` tells that it holds just after that
  /// time; otherwise this must be proved too. The basis has two or more beads, the paths are of degree 1, and
  /// not all radii are equal.
  [[nodiscard]] std::optional<Failure> first_failure(const BeadPaths<Dimension>& paths, const Basis& basis,
                                                     BeadId bead, bool inside, double lower, double upper,
                                                     bool holds);
  /// Must be called when the paths change.
  void forget() { known_ = {}; }

 private:
  SphereEnclosure<Dimension> from_now_;  ///< of known_, from known_from_ on
  Basis known_;
  double known_from_ = 0;
};

}  // namespace kds
