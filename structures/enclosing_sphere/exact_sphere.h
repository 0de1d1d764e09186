#pragma once
// Minimum enclosing spheres of balls in exact arithmetic, in the plane and in space, for equal or unequal
// radii. Computes the sphere that touches the balls of a basis from outside, whether it is their minimum
// enclosing sphere, and whether it holds another ball. Every decision is the sign of some A + B sqrt(D) over
// integers. The formulas and the choice of the root are those of certificates/types/ball_in_sphere.h. Equal
// radii are no special case, because their A vanish. A decision takes microseconds, so these functions serve
// only where doubles cannot decide.
//
// The formulas also accept doubles with error bounds (rounding_error.h). An uncertain sign then counts as
// negative, so "yes" is proved and "no" proves nothing.

#include <array>
#include <concepts>
#include <optional>
#include <span>
#include <vector>

#include "motions/numbers/exact_number.h"
#include "motions/numbers/rounding_error.h"
#include "structures/enclosing_sphere/basis.h"
#include "structures/enclosing_sphere/cage.h"
#include "structures/necklace/balls.h"

namespace kds {

template <int Dimension, class Number>
struct BallOver {
  std::array<Number, Dimension> center;
  Number radius;
};
/// Coordinates and radius, in units of a power of two that all balls of a set share.
template <int Dimension>
using IntegerBall = BallOver<Dimension, Integer>;

/// Returns the exponent of the greatest power of two that divides all coordinates and radii of these beads.
template <int Dimension>
[[nodiscard]] int whole_unit(const Balls<Dimension>& balls, BeadId first, BeadId last);
template <int Dimension>
[[nodiscard]] IntegerBall<Dimension> whole_ball(const Balls<Dimension>& balls, BeadId bead, int unit);

/// The smallest sphere that touches all balls of a basis from outside, with its centre in their affine hull.
template <int Dimension, class Number>
class TouchingSphere {
 public:
  using Ball = BallOver<Dimension, Number>;

  /// Takes 1 to Dimension + 1 balls. Returns none if the centres are affinely dependent or if no such sphere
  /// exists.
  [[nodiscard]] static std::optional<TouchingSphere> touching(std::span<const Ball> basis);

  /// Returns whether the centre lies strictly inside the simplex of centres. The sphere is then the minimum
  /// enclosing sphere of the basis, and no ball is superfluous.
  [[nodiscard]] bool is_proper() const;
  /// Returns whether the ball is inside or touches from inside.
  [[nodiscard]] bool holds(const Ball& ball) const;
  /// Returns the sphere with each coordinate and the radius rounded to within 2^-52 of their size, in the
  /// range of doubles.
  [[nodiscard]] Sphere rounded(int unit) const requires(std::same_as<Number, Integer>);

 private:
  TouchingSphere() = default;

  Ball base_;
  std::size_t m_ = 0;  // number of further balls of the basis
  std::array<std::array<Number, Dimension>, 3> d_;
  std::array<Number, 3> ae_, as_;            // A e and A s, e_i = |d_i|^2 - s_i^2
  std::array<Number, Dimension> qae_, qas_;  // Q A e and Q A s
  Number g_{1}, a_{-1}, b_{0}, c_{0}, discriminant_{0};
};

template <int Dimension>
using ExactSphere = TouchingSphere<Dimension, Integer>;

/// Returns the basis of a few balls that are known to have one: the first, by size, then by indices, of the
/// proper bases that hold all others. The result lists indices in `balls`, ascending.
template <int Dimension>
[[nodiscard]] std::vector<std::size_t> exact_basis_among(std::span<const IntegerBall<Dimension>> balls);

/// Returns the smallest sphere around the balls of a basis, rounded like TouchingSphere::rounded. Some of its
/// beads may be superfluous.
template <int Dimension>
[[nodiscard]] Sphere exact_sphere_of(const Basis& basis, const Balls<Dimension>& balls);

/// Selects whether doubles may sort out the beads that are clearly inside, so that only the others are
/// decided exactly.
enum class ExactUse { where_needed, everywhere };

/// Computes the minimum enclosing sphere of beads first..last; filters fall back on this function. Replaces
/// `basis`, at most Dimension + 1 arbitrary beads of the range, by their basis. Returns their sphere,
/// rounded. If `of_points`, it is the sphere of their centres, which requires equal radii. Always terminates,
/// because the sphere grows with every pivot.
template <int Dimension>
Cage<Dimension> enclosing_sphere_exactly(const Balls<Dimension>& balls, BeadId first, BeadId last,
                                         Basis& basis, bool of_points, ExactUse use = ExactUse::where_needed);

}  // namespace kds
