#pragma once
// Minimum enclosing spheres of balls in exact arithmetic, in the plane and in space, radii equal or not: the
// sphere that touches the balls of a basis from outside, whether it is the smallest that encloses them, and
// whether it holds another ball. Every decision is the sign of some A + B sqrt(D) over integers; formulas and
// the choice of the root as in certificates/types/ball_in_sphere.h. Equal radii need no case of their own:
// their A vanish. Slow, microseconds a decision: for what doubles cannot decide.
//
// The formulas also take doubles with error bounds (tracked_double.h). A sign that is not certain then
// counts as negative, so "yes" is proved and "no" means nothing.

#include <array>
#include <concepts>
#include <optional>
#include <span>
#include <vector>

#include "certificates/base/relaxation.h"
#include "motions/numbers/exact_number.h"
#include "motions/numbers/tracked_double.h"
#include "structures/enclosing_sphere/basis.h"
#include "structures/necklace/balls.h"
#include "structures/necklace/sphere.h"

namespace kds {

template <int Dimension, class Number>
struct BallOver {
  std::array<Number, Dimension> center;
  Number radius;
};
/// Coordinates and radius in units of a power of two that all balls of a set share.
template <int Dimension>
using IntegerBall = BallOver<Dimension, Integer>;

/// The greatest power of two of which all coordinates and radii of these beads are whole multiples.
template <int Dimension>
[[nodiscard]] int whole_unit(const Balls<Dimension>& balls, BeadId first, BeadId last);
template <int Dimension>
[[nodiscard]] IntegerBall<Dimension> whole_ball(const Balls<Dimension>& balls, BeadId bead, int unit);

/// The smallest sphere that touches all balls of a basis from outside, its centre in their affine hull.
template <int Dimension, class Number>
class TouchingSphere {
 public:
  using Ball = BallOver<Dimension, Number>;

  /// 1 to Dimension + 1 balls. None if the centres are affinely dependent or there is no such sphere.
  [[nodiscard]] static std::optional<TouchingSphere> touching(std::span<const Ball> basis);

  /// The centre lies strictly inside the simplex of centres: the sphere is the smallest that encloses the
  /// basis, and no ball is to spare.
  [[nodiscard]] bool is_proper() const;
  /// Inside, or touching from inside.
  [[nodiscard]] bool holds(const Ball& ball) const;
  /// The same of the sphere with its radius made larger by a share of itself; where the ball and the basis
  /// are of one radius, by a share of the radius of the centres' sphere, which is less.
  [[nodiscard]] bool holds_when_larger(const Ball& ball, const Relaxation& by) const
      requires(std::same_as<Number, Integer>);
  /// Each coordinate and the radius rounded to within 2^-52 of their size, where doubles reach.
  [[nodiscard]] Sphere rounded(int unit) const requires(std::same_as<Number, Integer>);

 private:
  TouchingSphere() = default;

  Ball base_;
  std::size_t m_ = 0;  // further balls of the basis
  std::array<std::array<Number, Dimension>, 3> d_;
  std::array<Number, 3> ae_, as_;            // A e and A s, e_i = |d_i|^2 - s_i^2
  std::array<Number, Dimension> qae_, qas_;  // Q A e and Q A s
  Number g_{1}, a_{-1}, b_{0}, c_{0}, discriminant_{0};
};

template <int Dimension>
using ExactSphere = TouchingSphere<Dimension, Integer>;

/// The basis of a few balls, one that is known to exist: the first, by size, then by places, of the proper
/// ones that hold all others. Places in `balls`, ascending.
template <int Dimension>
[[nodiscard]] std::vector<std::size_t> exact_basis_among(std::span<const IntegerBall<Dimension>> balls);

/// The smallest sphere around the balls of a basis, rounded as above; some may be to spare.
template <int Dimension>
[[nodiscard]] Sphere exact_sphere_of(const Basis& basis, const Balls<Dimension>& balls);

}  // namespace kds
