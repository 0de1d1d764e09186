#pragma once
// The gap between a ball and a moving sphere (sphere_enclosure.h) in four parts of a step: G = rho - s_b -
// |c_b
// - x|, positive while the ball is inside.
//
// With p = c_b - z', linear, it is rho' - s_b - |p|, concave, to within E + H, and at the ends of a period to
// within rounding. Its slope is rho'' - s_b' - p.p'/|p|, falling, to within |xi'| + |eta'| + 2 E |p'| / |p|.
//
// Its roots are among those of the radical's norm (ball_in_sphere.h). Where G = 0 is simple the norm changes
// sign as well, if its other factor A - B sqrt(D) does not vanish there: with W = c_b.q - s_b (times g) and T
// = c_b.x - e_b - s_b rho = ((rho - s_b)^2 - |c_b - x|^2) / 2 (times g) it is 2 W rho sqrt(D) - T (b +
// sqrt(D)). Where |b| <= f sqrt(D) it does not vanish while 2 |W| rho > (1 + f) |T|. And f = 1 where |q| < 1,
// since D = b^2 + (1 - |q|^2) |x - q rho|^2; else sqrt(D) = rho - x.q >= L rho (sphere_chord.h) and b = x.q -
// |q|^2 rho make it |q| (1 + |q|) / L.

#include "structures/moving_sphere/sphere_enclosure.h"

namespace kds {

/// Times 1 or -1: what is positive while a certificate holds.
struct SphereGaps {
  using Four = std::array<double, 4>;

  std::array<Four, 2> at_end;      // of the chord
  Four loss_at_ends, least;        // and its least value
  Four slowest, fastest;           // slopes, in units of the period
  std::array<Four, 3> square;      // coefficients of (rho' - s)^2 - |p|^2, by powers
  Four loss, apart;                // what |c_b - x| is at least
  std::array<Four, 2> lever;       // W at both ends
  Four lever_error, other_factor;  // and (1 + f) |T| / (2 rho |G|) at most
};

/// The gap at four times: each value errs by at most its loss.
struct GapsAt {
  std::array<double, 4> value, loss;
  unsigned proved;  // one bit for each time; without it nothing is known then
};

/// `side`: 1 of a ball that is to be inside, else -1.
template <int Dimension>
void find_gaps(const BeadPaths<Dimension>& paths, const SphereEnclosure<Dimension>& sphere, BeadId base,
               BeadId bead, double side, SphereGaps& gaps);

/// For a basis of two or more, where its sphere touches all of its balls from outside (that n.q < 1 at these
/// times is proved here).
template <int Dimension>
void find_gaps_at(const BeadPaths<Dimension>& paths, const Basis& basis, BeadId bead, double side,
                  const std::array<double, 4>& times, GapsAt& gaps);

}  // namespace kds
