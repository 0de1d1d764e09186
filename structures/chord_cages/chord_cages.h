#pragma once
// Chord cages: spheres of a hierarchy's nodes that are right at the ends of a step and blended in between,
// with no certificate and no event (docs/accuracy.md). At each control point of the motion a node has a
// sphere around its balls there; centre and radius are the Bezier curves of these spheres, chords where the
// motion is linear.
//
// They hold every bead at all times, exactly, for centres and radii as they stand, which are doubles. Let
// x_k, r_k be a bead's control points and c_k, R_k the node's. The sphere at each is made such that |x_k -
// c_k| + r_k <= R_k, its radius being rounded up. With B_k(u) >= 0 the Bernstein polynomials, whose sum is 1,
//
//   |x(u) - c(u)| = |sum B_k (x_k - c_k)| <= sum B_k |x_k - c_k| <= sum B_k (R_k - r_k) = R(u) - r(u).

#include <span>
#include <vector>

#include "motions/curves/curves.h"
#include "structures/chord_cages/outward_cages.h"
#include "structures/enclosing_sphere/cage.h"
#include "structures/hierarchy/layered_hierarchy.h"
#include "structures/hierarchy/static_wrapped_hierarchy.h"
#include "structures/necklace/balls.h"

namespace kds {

/// `Hierarchy`: StaticWrappedHierarchy, whose spheres are the smallest at each control point, or
/// LayeredHierarchy.
template <class Hierarchy>
class ChordCages {
 public:
  static constexpr int dimension = Hierarchy::dimension;
  using BallsAt = typename Hierarchy::BallsAt;

  /// `keep_bases`: those of each step's start, too, where there are any.
  ChordCages(std::span<const BeadRange> necklaces, int degree, bool keep_bases = false);

  /// Where beads are at the start of a first step. Until they move there are cages at control point 0 only.
  void build(const Curves<dimension>& curves);
  /// Takes the cages of a step. One that begins where the last has ended costs `degree` updates.
  void move_to(const Curves<dimension>& curves);

  [[nodiscard]] const NecklaceTree& tree() const { return hierarchy_.tree(); }
  [[nodiscard]] int degree() const { return static_cast<int>(cages_.size()) - 1; }
  /// Of all nodes at a control point, radii rounded up.
  [[nodiscard]] OutwardCages<dimension> cages(int k) const {
    return cages_[static_cast<std::size_t>(k)].outward();
  }
  [[nodiscard]] const BallsAt& balls(int k) const { return balls_[static_cast<std::size_t>(k)]; }
  /// Its bases are of the last control point: the step's end, or, before any step, where beads are built.
  /// The cages it had are those here.
  [[nodiscard]] const Hierarchy& hierarchy() const { return hierarchy_; }
  /// That control point.
  [[nodiscard]] int last() const { return moved_ ? degree() : 0; }
  /// The bases at the step's start, where they are kept.
  [[nodiscard]] std::span<const Basis> start_bases() const { return start_bases_; }

 private:
  void take(int k);

  Hierarchy hierarchy_;
  std::vector<BallsAt> balls_;                // of each control point
  std::vector<TakenCages<Hierarchy>> cages_;  // likewise
  std::vector<Basis> start_bases_;
  bool keep_bases_;
  bool moved_ = false;
};

}  // namespace kds
