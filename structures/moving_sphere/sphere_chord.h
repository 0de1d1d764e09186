#pragma once
// Which beads a minimum enclosing sphere can lose during a step or a part of it, and which its basis can,
// without a certificate for each: balls of any radii in motions of degree 1 to 3, in the plane and in space.
//
// All is seen from the basis' first ball: centres c_i(u), radii s_i(u), those of the first are zero. The
// sphere touches all of them from outside: its centre x(u), in their affine hull, and radius rho(u), less the
// first ball's, solve c_i.x = e_i + s_i rho, e_i = (|c_i|^2 - s_i^2) / 2, for i = 1 .. m, and |x| = rho. Let
// z'(u) and rho'(u) be its *chord*, linear between approximate ones at both ends. z' leaves residuals r_i =
// e_i + s_i rho' - c_i.z', and it may leave the hull, all of second order in the motion and bounded by their
// Bernstein coefficients; with a lower bound of the simplex' volume that bounds the part A of x - z' = A +
// (rho - rho') q that does not come from the radius, |A| <= B, and the slope |q| <= sum |s_i| / height_i.
// As rho grows, |x| - rho falls while n.q < 1, n = x / |x|, and of the two spheres that touch all balls this
// one is where it falls. So if 1 - n.q >= L > 0 wherever
//   |rho - rho'| <= (B + max ||z'| - rho'|) / L,   |x - z'| <= B + |q| |rho - rho'| =: E,
// then these hold, where |z'| sags below its chord by at most |z'(1) - z'(0)|^2 / (8 min |z'|). L is 1 - |q|,
// or, where balls of unequal radii are nearly flat and q is long, what the angle between it and z' leaves
// (least_lead in tangent_lanes.h). A bead with |c_b - z'| + s_b <= rho' - E - |rho - rho'| at all control
// points is inside all the time. Basis ball i stays one while its barycentric coordinate is positive: with
// w_i linear between those at both ends it is w_i to within the distance of x from sum w_i c_i by the height
// of ball i. Where all are, and rho >= s_i, the sphere is the smallest, whatever was known before.
//
// In linear motion all that comes between both ends vanishes there (linear_chords.h): bounds are 4 u (1-u)
// times a `dip`, and what has just risen from zero at the start can be told to stay so.
//
// All in double, with margins of four times its rounding, that of cutting a period out of the step included:
// what is proved here holds; what is not needs a certificate.

#include <array>
#include <cstdint>
#include <span>

#include "structures/enclosing_sphere/basis.h"
#include "structures/moving_sphere/bead_paths.h"

namespace kds {

template <int Dimension>
struct SphereChord {
  bool proved = false;     ///< else nothing is known of the sphere
  std::uint8_t stays = 0;  ///< a bit for each bead of the basis that cannot leave it: all, and it is a basis
  std::array<std::array<double, Dimension>, 2> center{};  ///< at both ends, from the basis' first bead
  std::array<double, 2> limit{};  ///< of a bead's distance plus its radius less the first bead's
  double dip = 0;                 ///< by which the limit is lower than it need be, but for 4 u (1-u) of that
  std::uint8_t rises = 0;  ///< a bit for each bead of the basis whose weight is positive from `sure` on

  /// Of balls of equal radii: makes it the chord of the sphere made larger by a factor of its radius. Where
  /// the limit is positive all the time it is below the radius, and so is what is gained below that of it.
  void enlarge(double factor) {
    if (!(factor > 1 && limit[0] > 0 && limit[1] > 0)) return;
    for (double& l : limit) l *= factor;
    dip *= factor;
  }
};

struct Period {
  double from = 0, to = 1;
  /// Until this time some bead's weight is known to be positive, for it has just risen from zero.
  double sure = 0;
};

/// The chords of up to four bases of one size, each in a period of its own: four cost little more than one.
template <int Dimension>
void sphere_chords(const BeadPaths<Dimension>& paths, std::span<const Basis> bases,
                   std::span<const Period> periods, std::span<SphereChord<Dimension>> chords);

template <int Dimension>
[[nodiscard]] SphereChord<Dimension> sphere_chord(const BeadPaths<Dimension>& paths, const Basis& basis,
                                                  const Period& period) {
  SphereChord<Dimension> chord;
  sphere_chords<Dimension>(paths, {&basis, 1}, {&period, 1}, {&chord, 1});
  return chord;
}

}  // namespace kds
