#pragma once
// Finds the time at which a ball crosses the sphere of a basis in linear motion, proved in double without the
// polynomials of the radical certificate (ball_in_sphere.h), whose degree is 10 to 12. For balls of unequal
// radii, in the plane and in space.
//
// The search is an interval subdivision with monotonicity tests. In a part of the step, the gap between ball
// and sphere (find_gaps) may be known to have a sign, or to rise or fall. If the gap falls or rises, its
// signs at both ends say whether it has a root there, which is then simple and the only one. Four parts are
// tested at once, and undecided parts are subdivided again. A root is estimated by the polynomial through the
// gap at five times, or by the chord, and then bracketed between two of four times around it whose signs are
// certain. The norm is also proved to have only this root in the bracket.

#include <array>
#include <optional>

#include "certificates/exact/instant.h"
#include "structures/moving_sphere/sphere_enclosure.h"

namespace kds {

// The bounds of the gap between a ball and a moving sphere (sphere_enclosure.h), in four parts of a step. The
// gap is G = rho - s_b - |c_b - x|, positive while the ball is inside.
//
// With p = c_b - z', which is linear, the gap equals rho' - s_b - |p|, which is concave, to within E + H, and
// at the ends of a period to within rounding. The slope of the gap equals rho'' - s_b' - p.p'/|p|, which
// falls, to within |xi'| + |eta'| + 2 E |p'| / |p|.
//
// The roots of the gap are among the roots of the radical's norm (ball_in_sphere.h). At a simple root of G
// the norm changes sign too, if its other factor A - B sqrt(D) does not vanish there. Let W = c_b.q - s_b
// (times g) and T = c_b.x - e_b - s_b rho = ((rho - s_b)^2 - |c_b - x|^2) / 2 (times g). Then the other
// factor is 2 W rho sqrt(D) - T (b + sqrt(D)). If |b| <= f sqrt(D), it does not vanish while 2 |W| rho >
// (1 + f) |T|. If |q| < 1, f = 1, since D = b^2 + (1 - |q|^2) |x - q rho|^2. Otherwise sqrt(D) = rho - x.q >=
// L rho (sphere_chord.h) and b = x.q - |q|^2 rho give f = |q| (1 + |q|) / L.

/// Bounds of the gap. All signs are multiplied by 1 or -1, so that positive means that the certificate holds.
struct SphereGaps {
  using Four = std::array<double, 4>;

  std::array<Four, 2> at_end;      // rho' - s_b - |p| at both ends
  Four loss_at_ends, least;        // error of at_end; a lower bound of the gap
  Four slowest, fastest;           // slopes, per period
  std::array<Four, 3> square;      // coefficients of (rho' - s)^2 - |p|^2, by powers
  Four loss, apart;                // apart: a lower bound of |c_b - x|
  std::array<Four, 2> lever;       // W at both ends
  Four lever_error, other_factor;  // other_factor: a bound of (1 + f) |T| / (2 rho |G|)
};

/// The gap at four times; each value has an error of at most its loss.
struct GapsAt {
  std::array<double, 4> value, loss;
  unsigned proved;  // one bit for each time; without it nothing is known
};

/// Bounds the gaps of a ball. `side` is 1 if the ball must be inside, else -1.
template <int Dimension>
void find_gaps(const BeadPaths<Dimension>& paths, const SphereEnclosure<Dimension>& sphere, BeadId base,
               BeadId bead, double side, SphereGaps& gaps);

/// Computes the gaps for a basis of two or more balls, at times when its sphere touches all of them from
/// outside. The function proves n.q < 1 at these times.
template <int Dimension>
void find_gaps_at(const BeadPaths<Dimension>& paths, const Basis& basis, BeadId bead, double side,
                  const std::array<double, 4>& times, GapsAt& gaps);

template <int Dimension>
class GapRoots {
 public:
  /// Returns, if doubles prove it, when the certificate that `bead` is inside the sphere of `basis` (outside,
  /// unless `inside`) first fails after a time in [lower, upper]. `holds` means that the certificate holds
  /// just after that time; otherwise this must be proved too. The basis has two or more beads, the paths are
  /// of degree 1, and not all radii are equal.
  [[nodiscard]] std::optional<Failure> first_failure(const BeadPaths<Dimension>& paths, const Basis& basis,
                                                     BeadId bead, bool inside, double lower, double upper,
                                                     bool holds);
  /// Must be called when the paths change.
  void forget() { known_ = {}; }

 private:
  SphereEnclosure<Dimension> from_now_;  ///< for known_, from known_from_ on
  Basis known_;
  double known_from_ = 0;
};

}  // namespace kds
