#pragma once
// The displacement of beads in a step: how far they stray from their positions at an earlier reference frame,
// without the drift common to all. A coordinate difference of two beads changes by at most the sum of both
// displacements. Displacements are proved upper bounds, including rounding. The displacement is infinite for
// a bead whose weight or radius changes.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "motions/curves/curves.h"
#include "motions/numbers/lanes.h"
#include "motions/views/motion_view.h"

namespace kds {

/// `channels` selects whether weights and radii matter: if a selected one changes, the bead's displacement is
/// infinite.
template <int Dimension, Channels channels = all_channels>
class Displacements {
 public:
  [[nodiscard]] bool has_reference() const { return !reference_.empty(); }
  void forget_reference() { reference_.clear(); }
  /// Sets the reference frame: the start of the motion's step.
  void set_reference(const Curves<Dimension>& motion) {
    reference_.resize(motion.bead_count());
    for (BeadId b = 0; b < reference_.size(); ++b) {
      const Lanes p = point(motion, b, 0);
      for (int i = 0; i < static_cast<int>(Lanes::width); ++i)
        reference_[b][static_cast<std::size_t>(i)] = p.v[i];
    }
    if constexpr (channels.radii) {
      radii_.resize(motion.bead_count());
      for (BeadId b = 0; b < radii_.size(); ++b) radii_[b] = motion.radius(b, 0);
    }
  }

  /// Measures a step of the motion. For each bead, takes the largest displacement of its control points,
  /// which bounds that of the whole step.
  void look_at(const Curves<Dimension>& motion) {
    strays_.resize(reference_.size());
    measure(motion, drift_of(motion));
  }
  [[nodiscard]] std::span<const double> strays() const { return strays_; }

 private:
  static_assert(Dimension < Lanes::width);
  using Drift = Coefficients<Lanes>;  // the drift of each control point

  /// Returns a control point in lanes: coordinates, then the weight, then zeros.
  [[nodiscard, gnu::always_inline]] static Lanes point(const Curves<Dimension>& motion, BeadId b, int k) {
    const double* p = motion.control_point(b, k);
    if constexpr (Dimension == 3) return Lanes::load(p);
    Lanes::Vector v{};
    for (int i = 0; i <= Dimension; ++i) v[i] = p[i];
    return v;
  }

  [[nodiscard, gnu::always_inline]] Lanes moved(const Curves<Dimension>& motion, BeadId b, int k) const {
    return point(motion, b, k) - Lanes(Lanes::load(reference_[b].data()));
  }

  /// Returns the drift. The bounds hold for any vector; the mean displacement of a sample of beads keeps them
  /// small. Weights do not drift.
  [[nodiscard]] Drift drift_of(const Curves<Dimension>& motion) const {
    constexpr std::size_t most = 512;
    const auto stride = static_cast<BeadId>(1 + reference_.size() / most);
    Drift drift;
    drift.resize(static_cast<std::size_t>(motion.own_degree()) + 1);
    for (int k = 0; k <= motion.own_degree(); ++k) {
      Lanes sum(0.0), count(0.0);
      for (BeadId b = 0; b < reference_.size(); b += stride) {
        sum += moved(motion, b, k);
        count += Lanes(1.0);
      }
      sum = sum / count;
      for (int i = 0; i < static_cast<int>(Lanes::width); ++i) {
        if (i >= Dimension || !std::isfinite(sum.v[i])) sum.v[i] = 0;
      }
      drift[static_cast<std::size_t>(k)] = sum;
    }
    return drift;
  }

  [[KDS_LANES_TARGETS]] void measure(const Curves<Dimension>& motion, const Drift& drift) {
    const Lanes rounding(0x1p-51);  // more than enough for two differences
    const int degree = motion.own_degree();
    for (BeadId b = 0; b < reference_.size(); ++b) {
      Lanes most(0.0);
      bool same_radius = true;
      for (int k = 0; k <= degree; ++k) {
        const Lanes d = moved(motion, b, k);
        const Lanes alone = Lanes::abs(d - drift[static_cast<std::size_t>(k)]);
        most = Lanes::max(most, alone + rounding * (Lanes::abs(d) + alone));
        if constexpr (channels.radii) same_radius &= motion.radius(b, k) == radii_[b];
      }
      double stray = most.v[0];
      for (int axis = 1; axis < Dimension; ++axis) stray = std::max(stray, most.v[axis]);
      const bool same = same_radius && most.v[Dimension] == 0;  // no nonzero difference rounds to zero
      strays_[b] = same ? stray : std::numeric_limits<double>::infinity();
    }
  }

  std::vector<std::array<double, Lanes::width>> reference_;
  std::vector<double> radii_, strays_;
};

}  // namespace kds
