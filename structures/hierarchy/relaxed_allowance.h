#pragma once
// Computes how far every ball of a necklace, of any radius, may be out of the sphere of a basis during a
// whole step while its relaxed certificate (relaxed_membership.h) holds. Bounds of the sphere's path can then
// prove the certificate.
//
// Let |d| >= least and p >= p' for the distance and the sum of radii of the basis' two balls farthest apart,
// let r be the largest radius of all balls, and let R' >= R. Suppose least >= r and p' >= r. Then all
// certificates of unequal balls are relaxed. In their tau, |d|^2 + p^2 - 2 p r_j >= least^2 + p' (p' - 2 r)
// =: q, since p^2 - 2 p r grows for p >= r. Let h = eps q / 2 / ((2 + eps) R'). As q <= 4 R^2, h <= eps R,
// and (R - r_j + h)^2 - (R - r_j)^2 <= h (2 R + h) <= tau.
//
// A ball that is out by h is therefore allowed. The certificate of equal radii allows it too: there q <=
// |d|^2 <= 4 R_c^2, and h <= eps R_c. The radius is at most that of the centres' sphere, which is at most
// sqrt(3/8) times their largest distance (Jung), plus the largest radius: this sum is R'.

#include <algorithm>
#include <array>
#include <cmath>

#include "certificates/types/relaxed_membership.h"
#include "motions/curves/curves.h"
#include "structures/enclosing_sphere/basis.h"

namespace kds {

class RelaxedAllowance {
 public:
  /// Without a relaxation nothing is allowed.
  explicit RelaxedAllowance(const Relaxation& relaxation) : share_(relaxation.share()) {}

  [[nodiscard]] bool any() const { return share_ > 0; }
  template <int Dimension>
  void start_step(const Curves<Dimension>& curves) {
    if (!any()) return;
    largest_ = 0;
    for (BeadId b = 0; b < curves.bead_count(); ++b)
      for (int k = 0; k <= curves.own_degree(); ++k) largest_ = std::max(largest_, curves.radius(b, k));
  }
  /// Returns zero if nothing is known.
  template <int Dimension>
  [[nodiscard]] double of(const Curves<Dimension>& curves, const Basis& basis) const {
    if (basis.size < 2) return 0;
    std::array<BeadId, Basis::max_size> beads = basis.beads;
    const auto ordered = std::span(beads).first(basis.size);
    detail::put_farthest_first(curves, ordered);
    const double least = detail::least_distance(curves, beads[0], beads[1]);
    double sum = HUGE_VAL, square = 0;
    for (int k = 0; k <= curves.own_degree(); ++k) {
      sum = std::min(sum, (curves.radius(beads[0], k) + curves.radius(beads[1], k)) * (1 - 0x1p-50));
      for (std::size_t i = 0; i < ordered.size(); ++i) {
        for (std::size_t j = i + 1; j < ordered.size(); ++j) {
          const auto d = detail::control_difference(curves, beads[i], beads[j], k);
          square = std::max(square, detail::product(d, d));
        }
      }
    }
    if (!(least >= largest_ && sum >= largest_)) return 0;
    const double room = least * least + sum * (sum - 2 * largest_);
    const double radius = 0.6124 * std::sqrt(square) + largest_;
    const double allowed = 0.5 * share_ * room / ((2 + share_) * radius) * (1 - 0x1p-30);
    return allowed > 0 && allowed < HUGE_VAL ? allowed : 0;
  }

 private:
  double share_;
  double largest_ = 0;  ///< largest radius in the step
};

}  // namespace kds
