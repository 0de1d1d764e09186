#pragma once
// Keeps the closest of the pairs of balls that are offered, decided exactly.

#include <optional>

#include "structures/collision/closest_pair.h"
#include "structures/necklace/balls.h"

namespace kds {

template <int Dimension>
class ClosestSoFar {
 public:
  explicit ClosestSoFar(const Balls<Dimension>& balls) : balls_(&balls) {}

  /// Offers two beads in any order. If pairs are equally close, the first by ids wins.
  void offer(BeadId a, BeadId b);

  /// Returns an upper bound of the distance of the closest pair so far, infinite if there is none.
  [[nodiscard]] double at_most() const { return at_most_; }
  [[nodiscard]] std::optional<ClosestPair> result() const;

 private:
  [[nodiscard]] Eigen::Vector3d center(BeadId bead) const;
  void take(BeadId a, BeadId b);

  const Balls<Dimension>* balls_;
  std::optional<ClosestPair> best_;  // the sign is computed at the end
  double at_most_ = HUGE_VAL;
};

/// Returns a bound of the error of the distance of two balls, if it is computed as sqrt(square) - reach in
/// double.
[[nodiscard]] inline double error_of_gap(double distance_of_centers, double reach) {
  return 0x1p-46 * (distance_of_centers + reach) + 0x1p-490;
}

}  // namespace kds
