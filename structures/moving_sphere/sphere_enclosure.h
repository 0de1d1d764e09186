#pragma once
// Where the sphere of a basis is in four parts of a step, and how fast it moves and grows: balls of unequal
// radii in linear motion, in the plane and in space.
//
// With the notation of sphere_chord.h: in a period the centre is z' + xi, the radius rho' + eta, |xi| <= E,
// |eta| <= H. Differentiated, c_i.xi - s_i eta = r_i says
//   c_i.xi' - s_i eta' = r_i' - c_i'.xi + s_i' eta,
// so xi' is bounded as xi was, up to q eta', by residuals |r_i'| + |c_i'| E + |s_i'| H; with m normal to the
// hull, m.x = 0 bounds what leaves the hull by (|(m.z')'| + |m'| E) / |m|. And |x| = rho gives eta' = n.(z''
// + xi') - rho'', z'' and rho'' the chord's slopes. There xi' contains q eta', so eta' is bounded by the rest
// over L <= 1 - n.q. |z'|' is |z'(1)| - |z'(0)| to within |z''|^2 / min |z'|, and x/|x| differs from z'/|z'|
// by at most 2 E / |z'|. The slope q is known at the start, and from its residuals s_i - c_i.q for all of the
// period. In double with the margins of sphere_chord.h, of lengths as seen from the basis' first ball alone:
// 2^-45, since motion is linear (40 units of 2^-53 are rounded).

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
  std::array<std::array<Four, Dimension>, 2> center;  ///< at both ends, from the basis' first bead
  std::array<Four, 2> rho;                            ///< less the first bead's radius
  Four center_strays;                                 ///< E
  Four loss, loss_at_ends;                            ///< E + H in the period and at its ends
  Four rate_loss;                                     ///< |xi'| + |eta'|, in units of the period
  Four scale;                                         ///< no length that went in is larger
  std::array<Four, Dimension> q;                      ///< at the start
  Four q_error;                                       ///< in all of the period
  Four other_root;                                    ///< f of gap_bounds.h
  unsigned proved;                                    ///< a bit each
};

/// Encloses the sphere of a basis of two or more balls in four parts of the step. Paths must be of degree 1.
template <int Dimension>
void find_motion(const BeadPaths<Dimension>& paths, const Basis& basis, const std::array<Period, 4>& periods,
                 SphereEnclosure<Dimension>& motion);

}  // namespace kds
