#pragma once
// Centres as floats, for filters: coordinate x becomes f, the float nearest to x scale - shift. What is told
// from floats must never miss two balls that meet; this is what makes it so.
//
// Let u = 2^-24, M the frame's bound, at least 2^-30, and every |f| at most M. The scale is a power of two,
// so that X = x scale - shift is rounded twice, once of them to float: |f - X| <= u (1 + 2^-19) M, what
// underflows included. A ball of radius r gets the float radius
//
//   R  =  (1 + 2^-20) r scale + 2^-21 M          (float_radius; 2^-20 = 16 u, 2^-21 = 8 u)
//
// rounded to float. Let two balls meet, S = (r + s) scale, so that their X are no farther apart than S and
// their f no farther than S + 2 sqrt(3) u (1 + 2^-19) M. Then
//
//   1. The sum of the squares of the differences of their f, in floats, errs by less than (1 + u)^5, so its
//      root is at most (1 + 2.6 u) S + 3.48 u M. The float (R + R')^2 has lost less than (1 - u)^5 with all
//      roundings of the radii, and its root is at least (1 + 13 u) S + 15 u M: not less. (Squares that
//      underflow are below 2^-126, and (R + R')^2 is at least 2^-100.)
//   2. f - R rounded is above f - R by u (M + R) at most, f + R below by as much. So on each axis f - R <=
//      f' + R' in floats: the difference f - f' is at most S + 3.48 u M, and R + R' - u (2 M + R + R') at
//      least (1 + 13 u) S + 13 u M. Boxes of beads' f - R and f + R, minimum and maximum, meet.
//
//   3. A bead with f then and f' now, |f| <= M, |f'| <= M + |f' - f|: its X has moved by at most
//      |f' - f| (1 + 1.8 u) + 3.48 u M, and the root of the sum of squares has lost less than 2.6 u.
//
// A frame may have axes of its own, of length one and across each other up to 2^-40. Its X are sums of
// products with them: all roundings of these come to less than 2^-49 M, or of |f' - f| where that is larger,
// and lengths differ by less than 2^-39 of themselves. Both are below 2^-14 u, which 2^-19 u M above and what
// 1 to 3 leave of S and |f' - f|, several u, have room for.
//
// Balls up to a gap g apart are those that meet with radii g / 2 larger.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

#include "structures/necklace/balls.h"

namespace kds {

/// Of a frame, one a row.
template <int Dimension>
using Axes =
    std::array<std::array<double, static_cast<std::size_t>(Dimension)>, static_cast<std::size_t>(Dimension)>;

template <int Dimension>
struct FloatFrame {
  std::array<double, static_cast<std::size_t>(Dimension)> shift{};
  double scale = 1;
  double bound = 0;                     ///< M; 0: a frame of no scene
  std::optional<Axes<Dimension>> axes;  ///< none: those of the coordinates

  /// R before it is rounded to float.
  [[nodiscard]] double float_radius(double radius) const {
    return radius * (scale * (1 + 0x1p-20)) + bound * 0x1p-21;
  }
  /// How far a bead is at most from where it was when all |f| were at most the bound, by the greatest square
  /// of the distance between its f.
  [[nodiscard]] double farthest(float square) const {
    const double length = std::sqrt(double{square}) * (1 + 0x1p-20) + bound * 0x1p-21;
    return length / scale + std::numeric_limits<double>::denorm_min();
  }
};

/// The largest float radius that squares do not overflow of, by far.
inline constexpr float largest_float_radius = 0x1p40F;

/// From coordinates of beads to X in a frame with axes, in doubles; `count` is a multiple of four. The two
/// may be the same arrays.
template <int Dimension>
void place_along_axes(const FloatFrame<Dimension>& frame,
                      const std::array<const double*, static_cast<std::size_t>(Dimension)>& coordinates,
                      const std::array<double*, static_cast<std::size_t>(Dimension)>& places,
                      std::size_t count);

/// The scene's box and its largest radius.
template <int Dimension>
struct SceneBox {
  std::array<double, static_cast<std::size_t>(Dimension)> low{}, high{};
  double largest_radius = 0;
};

namespace detail {

struct NumberRange {
  double least, greatest;
};
/// Of `count` numbers, at least one, none of them NaN; two at a time.
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

/// Of one bead or more.
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

/// With room for beads that move on: `bound` is twice the largest that the scene's coordinates can be. Along
/// the coordinates' axes these are below 1, as are the radii and half the gap. Radii and gap finite.
template <int Dimension>
[[nodiscard]] FloatFrame<Dimension> fit_float_frame(
    const SceneBox<Dimension>& box, double gap, const std::optional<Axes<Dimension>>& axes = std::nullopt) {
  FloatFrame<Dimension> frame;
  frame.axes = axes;
  double largest = std::max(0.5 * gap, box.largest_radius);
  double size = largest;  // half the longest side of the box, or the largest radius
  for (std::size_t axis = 0; axis < Dimension; ++axis) {
    largest = std::max({largest, std::abs(box.low[axis]), std::abs(box.high[axis])});
    size = std::max(size, 0.5 * box.high[axis] - 0.5 * box.low[axis]);
  }
  // |x| scale below 2^100: differences of such large coordinates are no smaller than 2^47, or zero.
  const int up = largest > 0 ? 100 - std::ilogb(largest) - 1 : 0;
  const int wanted = size > 0 ? -std::ilogb(size) - 1 : up;
  frame.scale = std::ldexp(1.0, std::min({wanted, up, 1023}));
  double farthest = 0x1p-31;
  for (std::size_t axis = 0; axis < Dimension; ++axis) {
    frame.shift[axis] = (0.5 * box.low[axis] + 0.5 * box.high[axis]) * frame.scale;
    farthest = std::max({farthest, std::abs(box.low[axis] * frame.scale - frame.shift[axis]),
                         std::abs(box.high[axis] * frame.scale - frame.shift[axis])});
  }
  // Turned, a corner of the box may lie on an axis.
  frame.bound = axes ? 4 * farthest : 2 * farthest;
  return frame;
}

}  // namespace kds
