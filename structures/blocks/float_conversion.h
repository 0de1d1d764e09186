#pragma once
// Converts centres to floats for filters: coordinate x becomes f, the float nearest to x scale - shift. A
// filter on these floats must never miss two balls that meet. The proof follows.
//
// Let u = 2^-24, let M be the bound of the conversion, at least 2^-30, and let every |f| be at most M. The
// scale is a power of two. Hence X = x scale - shift is rounded twice, once of these to float: |f - X| <= u
// (1 + 2^-19) M, underflow included. A ball of radius r gets the float radius
//
//   R  =  (1 + 2^-20) r scale + 2^-21 M          (float_radius; 2^-20 = 16 u, 2^-21 = 8 u)
//
// rounded to float. Let two balls meet and let S = (r + s) scale. Then their X are no farther apart than S,
// and their f no farther than S + 2 sqrt(3) u (1 + 2^-19) M. Three consequences follow:
//
//   1. Distances. The sum of squared differences of their f, computed in floats, has a relative error below
//      (1 + u)^5, so its root is at most (1 + 2.6 u) S + 3.48 u M. The float (R + R')^2 has lost less than a
//      factor (1 - u)^5 by all roundings of the radii, so its root is at least (1 + 13 u) S + 15 u M, which
//      is not less. (Squares that underflow are below 2^-126, and (R + R')^2 is at least 2^-100.)
//   2. Boxes. f - R rounded exceeds f - R by at most u (M + R), and f + R rounded falls below f + R by at
//      most as much. On each axis the difference f - f' is at most S + 3.48 u M, and R + R' - u
//      (2 M + R + R') is at least (1 + 13 u) S + 13 u M. So f - R <= f' + R' holds in floats on each axis.
//      The boxes of the beads, with sides from the minimum of f - R to the maximum of f + R, therefore meet.
//   3. Displacements. Let a bead have f before and f' now, with |f| <= M and |f'| <= M + |f' - f|. Then its X
//      has moved by at most |f' - f| (1 + 1.8 u) + 3.48 u M, and the computed root of the sum of squares has
//      lost less than 2.6 u.
//
// A conversion may have axes of its own. The axes have length one and are perpendicular, both up to 2^-40. X
// is then a sum of products with the axes. All roundings of these sums are below 2^-49 M, or below 2^-49 |f'
// - f| if that is larger. Lengths differ by less than 2^-39 of themselves. Both errors are below 2^-14 u and
// fit into 2^-19 u M above and into the several u of S and of |f' - f| that 1 to 3 leave.
//
// Balls up to a gap g apart are balls that meet once their radii grow by g / 2.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

#include "structures/necklace/balls.h"

namespace kds {

/// Axes of a conversion, one per row.
template <int Dimension>
using Axes =
    std::array<std::array<double, static_cast<std::size_t>(Dimension)>, static_cast<std::size_t>(Dimension)>;

/// Scales, shifts and perhaps turns coordinates so that floats hold them.
template <int Dimension>
struct FloatConversion {
  std::array<double, static_cast<std::size_t>(Dimension)> shift{};
  double scale = 1;
  double bound = 0;                     ///< M; 0 for a conversion without a scene
  std::optional<Axes<Dimension>> axes;  ///< none: the coordinate axes

  /// Returns R before it is rounded to float.
  [[nodiscard]] double float_radius(double radius) const {
    return radius * (scale * (1 + 0x1p-20)) + bound * 0x1p-21;
  }
  /// Returns an upper bound of the distance of a bead from an earlier position, at which all |f| were at most
  /// the bound. `square` is the greatest squared distance between the earlier and the present f.
  [[nodiscard]] double farthest(float square) const {
    const double length = std::sqrt(double{square}) * (1 + 0x1p-20) + bound * 0x1p-21;
    return length / scale + std::numeric_limits<double>::denorm_min();
  }
};

/// A float radius below which squares do not overflow, by a wide margin.
inline constexpr float largest_float_radius = 0x1p40F;

/// Converts coordinates of beads to X by a conversion with axes, in doubles. `count` is a multiple of four.
/// Input and output may be the same arrays.
template <int Dimension>
void turn_to_axes(const FloatConversion<Dimension>& conversion,
                  const std::array<const double*, static_cast<std::size_t>(Dimension)>& coordinates,
                  const std::array<double*, static_cast<std::size_t>(Dimension)>& turned, std::size_t count);

/// The scene's bounding box and its largest radius.
template <int Dimension>
struct SceneBox {
  std::array<double, static_cast<std::size_t>(Dimension)> low{}, high{};
  double largest_radius = 0;
};

namespace detail {

struct NumberRange {
  double least, greatest;
};
/// Returns the range of `count` numbers, at least one, none of them NaN. Works on two numbers at a time.
inline NumberRange range_of(const double* numbers, std::size_t count) {
  using Two = double __attribute__((vector_size(16)));
  const auto load = [numbers](std::size_t k) {
    Two two;
    __builtin_memcpy(&two, numbers + k, sizeof two);
    return two;
  };
  const Two first{numbers[0], numbers[0]};
  Two least = first, greatest = first, other_least = first, other_greatest = first;
  std::size_t k = 0;
  for (; k + 4 <= count; k += 4) {
    const Two a = load(k), b = load(k + 2);
    least = a < least ? a : least;
    greatest = a > greatest ? a : greatest;
    other_least = b < other_least ? b : other_least;
    other_greatest = b > other_greatest ? b : other_greatest;
  }
  NumberRange range{std::min({least[0], least[1], other_least[0], other_least[1]}),
                    std::max({greatest[0], greatest[1], other_greatest[0], other_greatest[1]})};
  for (; k < count; ++k) {
    range.least = std::min(range.least, numbers[k]);
    range.greatest = std::max(range.greatest, numbers[k]);
  }
  return range;
}

}  // namespace detail

/// Returns the box of a scene with at least one bead.
template <int Dimension>
[[nodiscard]] SceneBox<Dimension> scene_box(const Balls<Dimension>& balls) {
  SceneBox<Dimension> box;
  for (std::size_t axis = 0; axis < Dimension; ++axis) {
    const auto [least, greatest] = detail::range_of(balls.coordinates(axis), balls.size());
    box.low[axis] = least;
    box.high[axis] = greatest;
  }
  box.largest_radius =
      balls.equal_radii() ? balls.radius(0) : detail::range_of(balls.radii(), balls.size()).greatest;
  return box;
}

/// Returns a conversion with room for beads that move on: `bound` is twice the largest f that the scene's
/// coordinates can have. Along the coordinate axes the f are below 1, and so are the scaled radii and half
/// the scaled gap. Radii and gap are finite.
template <int Dimension>
[[nodiscard]] FloatConversion<Dimension> fit_float_conversion(
    const SceneBox<Dimension>& box, double gap, const std::optional<Axes<Dimension>>& axes = std::nullopt) {
  FloatConversion<Dimension> conversion;
  conversion.axes = axes;
  double largest = std::max(0.5 * gap, box.largest_radius);
  double size = largest;  // half the longest side of the box, or the largest radius
  for (std::size_t axis = 0; axis < Dimension; ++axis) {
    largest = std::max({largest, std::abs(box.low[axis]), std::abs(box.high[axis])});
    size = std::max(size, 0.5 * box.high[axis] - 0.5 * box.low[axis]);
  }
  // Keeps |x| scale below 2^100. Differences of coordinates this large are then zero or at least 2^47.
  const int limit = largest > 0 ? 100 - std::ilogb(largest) - 1 : 0;
  const int wanted = size > 0 ? -std::ilogb(size) - 1 : limit;
  conversion.scale = std::ldexp(1.0, std::min({wanted, limit, 1023}));
  double farthest = 0x1p-31;
  for (std::size_t axis = 0; axis < Dimension; ++axis) {
    conversion.shift[axis] = (0.5 * box.low[axis] + 0.5 * box.high[axis]) * conversion.scale;
    farthest = std::max({farthest, std::abs(box.low[axis] * conversion.scale - conversion.shift[axis]),
                         std::abs(box.high[axis] * conversion.scale - conversion.shift[axis])});
  }
  // With turned axes, a corner of the box may lie on an axis, so coordinates may be larger.
  conversion.bound = axes ? 4 * farthest : 2 * farthest;
  return conversion;
}

/// Returns axes that most bonds of a chain lie along, estimated from a sample of the bonds. Returns none if
/// the coordinate axes are about as good. If a chain is packed on a lattice or stretched along few
/// directions, the boxes of its pieces are small only if their sides lie along these directions. `scale` is a
/// power of two; coordinates times `scale` are of moderate size.
template <int Dimension>
[[nodiscard]] std::optional<Axes<Dimension>> bond_axes(const Balls<Dimension>& balls, double scale);

}  // namespace kds
