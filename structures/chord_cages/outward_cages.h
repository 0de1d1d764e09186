#pragma once
// A hierarchy's cages with radii rounded up. Centres and radii, as returned in doubles, hold the balls of
// their nodes exactly. The rounding happens on request, so a run that only maintains cages does not pay for
// it.

#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "structures/enclosing_sphere/cage.h"
#include "structures/enclosing_sphere/four_balls.h"
#include "structures/hierarchy/layered_hierarchy.h"
#include "structures/hierarchy/static_wrapped_hierarchy.h"
#include "structures/necklace/balls.h"

namespace kds {

/// A view of the cages of all nodes at one time.
template <int Dimension>
class OutwardCages {
 public:
  OutwardCages() = default;
  /// Each radius grows by `wider`, then by the share `of_radius` of itself and the share `of_center` of the
  /// centre's coordinates.
  OutwardCages(std::span<const Cage<Dimension>> cages, double wider, double of_radius, double of_center)
      : cages_(cages), wider_(wider), factor_(1 + of_radius), of_center_(of_center) {}

  [[nodiscard]] std::size_t size() const { return cages_.size(); }
  [[nodiscard]] Cage<Dimension> operator[](NodeId node) const {
    Cage<Dimension> cage = cages_[node];
    double size = 0;
    for (const double x : cage.center) size += std::abs(x);
    cage.radius = (cage.radius + wider_) * factor_ + of_center_ * size;
    return cage;
  }
  /// Returns four cages in four lanes. Each lane equals the single result, bit for bit.
  [[nodiscard, gnu::always_inline]] FourBalls<Dimension> four(const FourPlaces& nodes) const {
    FourBalls<Dimension> balls(cages_.data(), nodes);
    Lanes size = abs(balls.center[0]);
    for (std::size_t axis = 1; axis < Dimension; ++axis) size += abs(balls.center[axis]);
    balls.radius = (balls.radius + Lanes(wider_)) * Lanes(factor_) + Lanes(of_center_) * size;
    return balls;
  }

 private:
  std::span<const Cage<Dimension>> cages_;
  double wider_ = 0, factor_ = 1, of_center_ = 0;
};

/// Cages moved out of a hierarchy at one time.
template <class Hierarchy>
class TakenCages {
 public:
  static constexpr int dimension = Hierarchy::dimension;

  /// Takes the cages of `hierarchy`. `balls` are the balls it was last brought to; the hierarchy rebuilds its
  /// cages with the next balls.
  void take(Hierarchy& hierarchy, const typename Hierarchy::BallsAt& balls);
  [[nodiscard]] OutwardCages<dimension> outward() const;

 private:
  std::vector<Cage<dimension>> cages_;
  double wider_ = 0;
};

/// Returns a radius, rounded up, of a sphere with this centre around beads first..last.
template <int Dimension>
[[nodiscard]] double outward_radius(const Balls<Dimension>& balls, BeadId first, BeadId last,
                                    const Point<Dimension>& center);

}  // namespace kds
