#pragma once
// Encloses the sphere of a basis in four parts of a step: its position and how fast it moves and grows. For
// balls of unequal radii in linear motion, in the plane and in space.
//
// The notation is that of sphere_chord.h. In a period the centre is z' + xi and the radius rho' + eta, with
// |xi| <= E and |eta| <= H. The derivative of c_i.xi - s_i eta = r_i is
//
//   c_i.xi' - s_i eta' = r_i' - c_i'.xi + s_i' eta.
//
// So xi' is bounded like xi, up to q eta', with residuals |r_i'| + |c_i'| E + |s_i'| H. With m normal to the
// hull, m.x = 0 bounds the component outside the hull by (|(m.z')'| + |m'| E) / |m|. And |x| = rho gives
// eta' = n.(z'' + xi') - rho'', where z'' and rho'' are the chord's slopes. This xi' contains q eta', so eta'
// is bounded by the remaining terms over L <= 1 - n.q. |z'|' equals |z'(1)| - |z'(0)| to within |z''|^2 / min
// |z'|, and x/|x| differs from z'/|z'| by at most 2 E / |z'|.
//
// The slope q is known at the start, and its residuals s_i - c_i.q bound it for the whole period. Computed in
// double with the margins of sphere_chord.h for lengths relative to the basis' first ball alone: 2^-45, since
// motion is linear (40 units of 2^-53 are rounded).

#include <array>

#include "structures/enclosing_sphere/basis.h"
#include "structures/moving_sphere/bead_paths.h"
#include "structures/moving_sphere/sphere_chord.h"

namespace kds {

template <int Dimension>
struct SphereEnclosure {
  static constexpr std::size_t periods = 4;
  static constexpr double margin = 0x1p-45;
  using Four = std::array<double, periods>;

  std::array<Period, periods> period;
  std::array<std::array<Four, Dimension>, 2> center;  ///< at both ends, relative to the basis' first bead
  std::array<Four, 2> rho;                            ///< less the first bead's radius
  Four center_strays;                                 ///< the bound E
  Four loss, loss_at_ends;                            ///< E + H in the period and at its ends
  Four rate_loss;                                     ///< bounds |xi'| + |eta'|, per period
  Four scale;                                         ///< bounds all input lengths
  std::array<Four, Dimension> q;                      ///< at the start
  Four q_error;                                       ///< in the whole period
  Four other_root;                                    ///< f of gap_root.h
  unsigned proved;                                    ///< one bit per part
};

/// Encloses the sphere of a basis of two or more balls in four parts of the step. Paths must be of degree 1.
template <int Dimension>
void find_motion(const BeadPaths<Dimension>& paths, const Basis& basis, const std::array<Period, 4>& periods,
                 SphereEnclosure<Dimension>& motion);

}  // namespace kds
