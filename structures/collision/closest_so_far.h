#pragma once
// The closest of the pairs of balls that are offered, decided exactly.

#include <optional>

#include "structures/collision/closest_pair.h"
#include "structures/necklace/balls.h"

namespace kds {

template <int Dimension>
class ClosestSoFar {
 public:
  explicit ClosestSoFar(const Balls<Dimension>& balls) : balls_(&balls) {}

  /// Two beads in any order. Of equally close pairs the first by ids stays.
  void offer(BeadId a, BeadId b);

  /// No less than the distance of the pair that is closest so far; infinite without one.
  [[nodiscard]] double at_most() const { return at_most_; }
  [[nodiscard]] std::optional<ClosestPair> result() const;

 private:
  [[nodiscard]] Eigen::Vector3d center(BeadId bead) const;
  void take(BeadId a, BeadId b);

  const Balls<Dimension>* balls_;
  std::optional<ClosestPair> best_;  // its sign is told at the end
  double at_most_ = HUGE_VAL;
};

/// By how much at most the distance of two balls errs, computed as sqrt(square) - reach in double.
[[nodiscard]] inline double error_of_gap(double distance_of_centers, double reach) {
  return 0x1p-46 * (distance_of_centers + reach) + 0x1p-490;
}

}  // namespace kds
