#pragma once
// How far beads stray in a step from where they were at some earlier frame, drift common to all left out: no
// coordinate difference of two beads moves by more than the sum of what both stray. Upper bounds, proved,
// rounding included; infinite where a weight or radius changes.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "motions/bezier_motion.h"

namespace kds {

template <Motion M>
class Wandering {
 public:
  [[nodiscard]] bool has_reference() const { return !reference_.empty(); }
  void forget_reference() { reference_.clear(); }
  /// From now on beads stray from where they are at the start of the motion's step.
  void set_reference(const M& motion) {
    reference_.resize(motion.bead_count());
    for (BeadId b = 0; b < reference_.size(); ++b) {
      for (int axis = 0; axis < M::dimension; ++axis)
        reference_[b].center[static_cast<std::size_t>(axis)] = motion.coordinate(b, 0, axis);
      reference_[b].weight = motion.weight(b, 0);
      reference_[b].radius = motion.radius(b, 0);
    }
  }

  /// One number a bead for the whole step: the largest of its control points.
  void look_at(const M& motion) {
    strays_.assign(reference_.size(), 0);
    for (int k = 0; k <= M::degree; ++k) {
      const auto drift = drift_of(motion, k);
      for (BeadId b = 0; b < reference_.size(); ++b)
        strays_[b] = std::max(strays_[b], stray(motion, b, k, drift));
    }
  }
  [[nodiscard]] std::span<const double> strays() const { return strays_; }

 private:
  using Vector = std::array<double, static_cast<std::size_t>(M::dimension)>;
  struct Reference {
    Vector center;
    double weight, radius;
  };

  /// Any vector will do; the mean displacement does well.
  [[nodiscard]] Vector drift_of(const M& motion, int k) const {
    Vector sum{};
    for (BeadId b = 0; b < reference_.size(); ++b) {
      for (int axis = 0; axis < M::dimension; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        sum[a] += motion.coordinate(b, k, axis) - reference_[b].center[a];
      }
    }
    for (double& x : sum) {
      x /= static_cast<double>(reference_.size());
      if (!std::isfinite(x)) x = 0;
    }
    return sum;
  }

  [[nodiscard]] double stray(const M& motion, BeadId b, int k, const Vector& drift) const {
    constexpr double rounding = 0x1p-51;  // of two differences, and to spare
    const Reference& reference = reference_[b];
    if (motion.weight(b, k) != reference.weight || motion.radius(b, k) != reference.radius)
      return std::numeric_limits<double>::infinity();
    double most = 0;
    for (int axis = 0; axis < M::dimension; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      const double moved = motion.coordinate(b, k, axis) - reference.center[a];
      const double alone = std::abs(moved - drift[a]);
      most = std::max(most, alone + rounding * (std::abs(moved) + alone));
    }
    return most;
  }

  std::vector<Reference> reference_;
  std::vector<double> strays_;
};

}  // namespace kds
