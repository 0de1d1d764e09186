#pragma once
// When a ball crosses the sphere of a basis, in linear motion: proved in double without the polynomials of
// the radical certificate (ball_in_sphere.h), which are of degree 10 to 12. Balls of unequal radii, in the
// plane and in space.
//
// With the notation of sphere_path.h: in a period the centre is z' + xi, the radius rho' + eta, |xi| <= E,
// |eta| <= H. Differentiated, c_i.xi - s_i eta = r_i says
//   c_i.xi' - s_i eta' = r_i' - c_i'.xi + s_i' eta,
// so xi' is bounded as xi was, up to |q eta'|, by residuals |r_i'| + |c_i'| E + |s_i'| H; with n normal to
// the hull, n.x = 0 bounds what leaves the hull by (|(n.z')'| + |n'| E) / |n|. And |x| = rho gives eta' =
// (x/|x|).(z'' + xi') - rho'', z'' and rho'' the chord's slopes, where |z'|' is |z'(1)| - |z'(0)| to within
// |z''|^2 / min |z'|, and x/|x| differs from z'/|z'| by at most 2 E / |z'|.
//
// The gap of ball b, G = rho - s_b - |c_b - x|, is positive while it is inside. With p = c_b - z', linear, it
// is rho' - s_b - |p|, concave, to within E + H, and at the ends of the period to within rounding. Its slope
// is rho'' - s_b' - p.p'/|p|, falling, to within |xi'| + |eta'| + 2 E |p'| / |p|. So in a period it may be
// known that G has a sign, or that it rises, or falls; in the latter case its signs at both ends tell whether
// it has a root there, and that this is the only one and simple. Four periods are looked at side by side, and
// those that say nothing are cut again.
//
// Failure times name roots of the radical's norm. Where G = 0 is simple the norm changes sign as well, if its
// other factor A - B sqrt(D) does not vanish there: with W = c_b.q - s_b (times g) and T = c_b.x - e_b - s_b
// rho = ((rho - s_b)^2 - |c_b - x|^2) / 2 (times g) it is 2 W rho sqrt(D) - T (b + sqrt(D)), and |q| < 0.98
// makes |b| < 5 sqrt(D): it does not vanish while 2 |W| rho > 6 |T|. All in double with the margins of
// sphere_path.h.

#include <array>
#include <cstdint>
#include <optional>

#include "certificates/failure_time.h"
#include "structures/basis.h"
#include "structures/bead_paths.h"
#include "structures/sphere_path.h"

namespace kds {

namespace detail {

/// The sphere of a basis in four periods side by side.
template <int Dimension>
struct SpherePaths {
  static constexpr std::size_t periods = 4;
  using Four = std::array<double, periods>;

  std::array<Period, periods> period;
  std::array<std::array<Four, Dimension>, 2> center;
  std::array<Four, 2> rho;
  Four center_strays, loss, loss_at_ends, rate_loss, scale;
  std::array<Four, Dimension> q;
  Four q_error;
  unsigned proved;  ///< a bit each
};

}  // namespace detail

template <int Dimension>
class SphereCrossings {
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
  using Paths = detail::SpherePaths<Dimension>;

  Paths from_now_;  ///< of this basis from that time on
  Basis known_;
  double known_from_ = 0;
};

}  // namespace kds
