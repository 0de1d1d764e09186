#pragma once
// Chord cages: spheres of a hierarchy's nodes that are exact at the ends of a step and interpolated in
// between, without certificates or events (docs/accuracy.md). At each control point of the motion, a node has
// a sphere around its balls there. Centre and radius are the Bezier curves with these spheres as control
// points; if the motion is linear, they are chords.
//
// The cages hold every bead at all times. The statement is exact for the stored centres and radii, which are
// doubles. Let x_k, r_k be the control points of a bead and c_k, R_k those of the node. Each sphere satisfies
// |x_k - c_k| + r_k <= R_k because its radius is rounded up. The Bernstein polynomials B_k(u) are nonnegative
// and sum to 1, so
//
//   |x(u) - c(u)| = |sum B_k (x_k - c_k)| <= sum B_k |x_k - c_k| <= sum B_k (R_k - r_k) = R(u) - r(u).

#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "motions/curves/curves.h"
#include "structures/enclosing_sphere/cage.h"
#include "structures/hierarchy/layered_hierarchy.h"
#include "structures/hierarchy/static_wrapped_hierarchy.h"
#include "structures/necklace/balls.h"

namespace kds {

/// A view of the cages of all nodes at one time, with radii rounded up. Centres and radii, as returned in
/// doubles, hold the balls of their nodes exactly. The rounding happens on request, so a run that only
/// maintains cages does not pay for it.
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
  [[nodiscard, gnu::always_inline]] FourBalls<Dimension> four(const FourIndices& nodes) const {
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

/// `Hierarchy` is StaticWrappedHierarchy, whose spheres are the smallest at each control point, or
/// LayeredHierarchy.
template <class Hierarchy>
class ChordCages {
 public:
  static constexpr int dimension = Hierarchy::dimension;
  using BallsAt = typename Hierarchy::BallsAt;

  /// If `keep_bases`, the bases of each step's start are kept too, provided that the hierarchy has bases.
  ChordCages(std::span<const BeadRange> necklaces, int degree, bool keep_bases = false);

  /// Builds the cages at the beads' positions at the start of the first step. Until the beads move, only
  /// control point 0 has cages. Throws InputError if a radius exceeds the range of double.
  void build(const Curves<dimension>& curves);
  /// Computes the cages of a step. A step that begins at the end of the last one costs `degree` updates.
  /// Throws like build().
  void move_to(const Curves<dimension>& curves);

  [[nodiscard]] const NecklaceTree& tree() const { return hierarchy_.tree(); }
  [[nodiscard]] int degree() const { return static_cast<int>(cages_.size()) - 1; }
  /// Returns the cages of all nodes at a control point, with radii rounded up.
  [[nodiscard]] OutwardCages<dimension> cages(int k) const {
    return cages_[static_cast<std::size_t>(k)].outward();
  }
  [[nodiscard]] const BallsAt& balls(int k) const { return balls_[static_cast<std::size_t>(k)]; }
  /// Returns the hierarchy. The hierarchy's bases belong to control point last(): the end of the step or,
  /// before any step, the positions of build(). The hierarchy's own cages have been moved into this object.
  [[nodiscard]] const Hierarchy& hierarchy() const { return hierarchy_; }
  /// Returns the control point of the hierarchy's bases.
  [[nodiscard]] int last() const { return moved_ ? degree() : 0; }
  /// Returns the bases at the start of the step, if they are kept.
  [[nodiscard]] std::span<const Basis> start_bases() const { return start_bases_; }

 private:
  void take(int k);

  Hierarchy hierarchy_;
  std::vector<BallsAt> balls_;                // at each control point
  std::vector<TakenCages<Hierarchy>> cages_;  // at each control point
  std::vector<Basis> start_bases_;
  bool keep_bases_;
  bool moved_ = false;
};

}  // namespace kds
