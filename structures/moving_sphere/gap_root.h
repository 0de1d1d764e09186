#pragma once
// When a ball crosses the sphere of a basis, in linear motion: proved in double without the polynomials of
// the radical certificate (ball_in_sphere.h), which are of degree 10 to 12. Balls of unequal radii, in the
// plane and in space.
//
// In a part of the step it may be known that the gap between ball and sphere (gap_bounds.h) has a sign, or
// that it rises, or falls; in the latter case its signs at both ends tell whether it has a root there, and
// that this is the only one and simple. Four parts are looked at side by side, and those that say nothing are
// cut again. A root is guessed by the polynomial through the gap at five times, or else by the chord's, and
// then between two of four times about it; signs on both sides of it are certain. That it names the norm's
// only root there is proved too.

#include <optional>

#include "certificates/base/failure_time.h"
#include "structures/moving_sphere/sphere_enclosure.h"

namespace kds {

template <int Dimension>
class GapRoots {
 public:
  /// When the certificate that `bead` is inside (or, not `inside`, outside) the sphere of `basis` fails for
  /// the first time after a time in [lower, upper], if doubles prove it. `holds`: it is known to hold just
  /// after that time; else this has to be proved too. Bases of two or more; the paths are of degree 1 and of
  /// radii that are not all equal.
  [[nodiscard]] std::optional<Failure> first_failure(const BeadPaths<Dimension>& paths, const Basis& basis,
                                                     BeadId bead, bool inside, double lower, double upper,
                                                     bool holds);
  /// The paths are new.
  void forget() { known_ = {}; }

 private:
  SphereEnclosure<Dimension> from_now_;  ///< of this basis from that time on
  Basis known_;
  double known_from_ = 0;
};

}  // namespace kds
