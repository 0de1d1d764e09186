#pragma once
// Proves which beads a minimum enclosing sphere cannot lose during a step or a part of it, and which beads
// its basis cannot lose, without a certificate for each. For balls of any radii in motions of degree 1 to 3,
// in the plane and in space.
//
// All positions are relative to the basis' first ball: centres c_i(u) and radii s_i(u), with those of the
// first zero. The sphere touches all balls from outside. The sphere's centre x(u), in the affine hull of the
// centres, and its radius rho(u), less the first ball's, solve c_i.x = e_i + s_i rho, e_i =
// (|c_i|^2 - s_i^2) / 2, for i = 1 .. m, and |x| = rho. Let z'(u) and rho'(u) be its *chord*, linear between
// approximate values at both ends. z' leaves residuals r_i = e_i + s_i rho' - c_i.z', and it may leave the
// hull. Both effects are of second order in the motion and bounded by their Bernstein coefficients.
//
// Split x - z' = A + (rho - rho') q, where A does not come from the radius. A lower bound of the simplex'
// volume gives |A| <= B and |q| <= sum |s_i| / height_i. As rho grows, |x| - rho falls while n.q < 1, n = x /
// |x|. Two spheres touch all balls, and this sphere is the one where |x| - rho falls. So if 1 - n.q >= L > 0
// wherever
//
//   |rho - rho'| <= (B + max ||z'| - rho'|) / L,   |x - z'| <= B + |q| |rho - rho'| =: E,
//
// then these bounds hold. |z'| sags below its chord by at most |z'(1) - z'(0)|^2 / (8 min |z'|). L is 1 -
// |q|. If balls of unequal radii are nearly flat and q is long, L is instead derived from the angle between q
// and z' (least_lead in chord_lanes.h).
//
// A bead with |c_b - z'| + s_b <= rho' - E - |rho - rho'| at all control points is inside all the time. Basis
// ball i stays in the basis while its barycentric coordinate is positive. Let w_i be linear between the
// coordinates at both ends. The coordinate equals w_i to within the distance of x from sum w_i c_i, divided
// by the height of ball i. If all coordinates are positive and rho >= s_i, the sphere is the minimum
// enclosing sphere, whatever was known before.
//
// In linear motion all terms between both ends vanish there (linear_chords.h). Bounds are then 4 u (1-u)
// times a `dip`, and a coordinate that has just risen from zero at the start can be proved to stay positive.
//
// All computations are in double, with margins of four times the rounding, including the rounding from
// cutting a period out of the step. A condition that is proved here holds. Any other condition needs a
// certificate.

#include <array>
#include <cstdint>
#include <span>

#include "structures/enclosing_sphere/basis.h"
#include "structures/moving_sphere/bead_paths.h"

namespace kds {

template <int Dimension>
struct SphereChord {
  bool proved = false;     ///< otherwise nothing is known of the sphere
  std::uint8_t stays = 0;  ///< basis beads that cannot leave; if all, it is a basis
  std::array<std::array<double, Dimension>, 2> center{};  ///< at both ends, relative to the basis' first bead
  std::array<double, 2> limit{};  ///< for a bead's distance plus its radius less the first bead's
  double dip = 0;                 ///< the true limit is higher by this except for 4 u (1-u) of it
  std::uint8_t rises = 0;         ///< one bit for each basis bead whose weight is positive from `sure` on
};

struct Period {
  double from = 0, to = 1;
  /// Until this time some bead's weight is known to be positive, because it has just risen from zero.
  double sure = 0;
};

/// Computes the chords of up to four bases of one size, each in a period of its own. Four cost little more
/// than one.
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

/// Caches the chord of the last basis, so that a repeated query finds it.
template <int Dimension>
class ChordCache {
 public:
  /// Stores `chord` as the chord of `basis` in a period that ends with the step.
  void keep(const Basis& basis, const Period& period, const SphereChord<Dimension>& chord) {
    basis_ = basis;
    from_ = period.from;
    sure_ = period.sure;
    chord_ = chord;
  }
  void forget() { from_ = none; }

  /// Returns the chord of `basis`.
  [[nodiscard]] const SphereChord<Dimension>& of(const BeadPaths<Dimension>& paths, const Basis& basis,
                                                 const Period& period) {
    if (!(from_ == period.from && sure_ == period.sure && basis_ == basis))
      keep(basis, period, sphere_chord(paths, basis, period));
    return chord_;
  }

 private:
  static constexpr double none = -1;  // as from_: no chord is cached

  Basis basis_;
  double from_ = none, sure_ = 0;
  SphereChord<Dimension> chord_;
};

}  // namespace kds
