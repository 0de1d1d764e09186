#pragma once
// Random motions of a few beads, most of which are degenerate in some way.

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string_view>

#include "motions/curves/bezier_motion.h"
#include "tests/support/inputs/random.h"

namespace kds::test {

enum class MotionKind {
  generic,
  grid,         ///< small whole coordinates: coplanar, cospherical and coincident beads, simultaneous events
  coincident,   ///< every second bead is a copy
  collinear,    ///< all beads are on one moving line
  planar,       ///< all beads are in one moving plane
  cospherical,  ///< all beads start on the unit sphere, with small rational coordinates
  at_rest,
  ulp_steps,    ///< beads move by a unit or two in the last place
  tiny_steps,   ///< beads move by subnormal numbers
  far_away,     ///< all beads are near (2^40, 2^40, 2^40)
  mixed_scales  ///< numbers with very different exponents
};
inline constexpr std::array all_motion_kinds{
    MotionKind::generic,    MotionKind::grid,        MotionKind::coincident,  MotionKind::collinear,
    MotionKind::planar,     MotionKind::cospherical, MotionKind::at_rest,     MotionKind::ulp_steps,
    MotionKind::tiny_steps, MotionKind::far_away,    MotionKind::mixed_scales};

template <Motion M>
M random_motion(Random& random, std::size_t beads, MotionKind kind) {
  M motion(beads);
  const double offset = kind == MotionKind::far_away ? 0x1p40 : 0;
  const auto fresh = [&]() -> double {
    switch (kind) {
      case MotionKind::grid:
        return pick(random, -2, 2);
      case MotionKind::coincident:
      case MotionKind::collinear:
      case MotionKind::planar:
        return random() % 2 ? pick(random, -3, 3) : 0.25 * pick(random, -40, 40);
      case MotionKind::mixed_scales:
        return std::ldexp(uniform(random), pick(random, -120, 120));
      default:
        return offset + uniform(random);
    }
  };
  constexpr double sphere[6][3] = {{3, 4, 0}, {-4, 0, 3}, {0, -5, 0}, {5, 0, 0}, {0, 3, -4}, {0, 0, 5}};
  for (BeadId b = 0; b < beads; ++b) {
    for (int k = 0; k <= M::degree; ++k) {
      for (int axis = 0; axis < M::dimension; ++axis) {
        double x = fresh();
        if (kind == MotionKind::cospherical && k == 0) x = sphere[b % 6][axis];
        if (k > 0) {
          const double before = motion.coordinate(b, k - 1, axis);
          if (kind == MotionKind::at_rest) x = before;
          if (kind == MotionKind::tiny_steps) x = before + pick(random, -3, 3) * 0x1p-1074;
          if (kind == MotionKind::ulp_steps) {
            x = before;
            for (int step = pick(random, 0, 2); step > 0; --step)
              x = std::nextafter(x, random() % 2 ? 9.0 : -9.0);
          }
        }
        if (kind == MotionKind::tiny_steps && k == 0) x = pick(random, -3, 3) * 0x1p-1060;
        motion.set_coordinate(b, k, axis, x);
      }
      const double weight = random() % 2 || k == 0 ? uniform(random, 0, 0.5) : motion.weight(b, k - 1);
      const bool whole = kind == MotionKind::grid || kind == MotionKind::cospherical;
      motion.set_weight(b, k, whole ? 0 : weight);
      motion.set_radius(b, k, whole ? 0.5 * (b % 3) : std::sqrt(weight));
    }
  }
  for (BeadId b = 0; b < beads; ++b) {
    for (int k = 0; k <= M::degree; ++k) {
      if (kind == MotionKind::coincident && b % 2 == 1) {
        for (int axis = 0; axis < M::dimension; ++axis)
          motion.set_coordinate(b, k, axis, motion.coordinate(b - 1, k, axis));
      }
      if (kind == MotionKind::collinear && b >= 2) {  // whole multiples of a difference are exact
        const double share = pick(random, -2, 3);
        for (int axis = 0; axis < M::dimension; ++axis) {
          const double from = motion.coordinate(0, k, axis);
          motion.set_coordinate(b, k, axis, from + share * (motion.coordinate(1, k, axis) - from));
        }
      }
      if (kind == MotionKind::planar && M::dimension == 3)
        motion.set_coordinate(b, k, M::dimension - 1, motion.coordinate(0, k, 0));
    }
  }
  return motion;
}

/// Makes balls of unequal radii in space, the first with the smallest radius. At the start their smallest
/// enclosing sphere has radius 1 and touches the first four balls. The centres are within `height` of one
/// plane. Centres move by up to `pace`.
template <Motion M>
M nearly_flat_basis(Random& random, std::size_t beads, double height, double pace) {
  static_assert(M::dimension == 3);
  M motion(beads);
  for (BeadId b = 0; b < beads; ++b) {
    const double radius = b == 0 ? 0.01 : uniform(random, 0.1, 0.9),
                 turn = 0.5 * std::numbers::pi * (b + uniform(random, 0, 0.3));
    const double out = (1 - radius) * (b < 4 ? 1 : uniform(random, 0.5, 1)),
                 up = b % 2 == 0 ? height : -height;
    const double flat = std::sqrt(1 - up * up);
    const std::array<double, 3> center{out * flat * std::cos(turn), out * flat * std::sin(turn), out * up};
    for (int k = 0; k <= M::degree; ++k) {
      for (int axis = 0; axis < 3; ++axis) {
        const double x = center[static_cast<std::size_t>(axis)];
        motion.set_coordinate(b, k, axis, k == 0 ? x : x + pace * uniform(random));
      }
      motion.set_radius(b, k, radius);
      motion.set_weight(b, k, 0);
    }
  }
  return motion;
}

/// Multiplies coordinates and radii by 2^exponent, and weights by its square.
template <Motion M>
void scale(M& motion, int exponent) {
  for (BeadId b = 0; b < motion.bead_count(); ++b) {
    for (int k = 0; k <= M::degree; ++k) {
      for (int axis = 0; axis < M::dimension; ++axis)
        motion.set_coordinate(b, k, axis, std::ldexp(motion.coordinate(b, k, axis), exponent));
      motion.set_radius(b, k, std::ldexp(motion.radius(b, k), exponent));
      const double w = std::ldexp(motion.weight(b, k), 2 * exponent);
      motion.set_weight(b, k, std::isfinite(w) ? w : std::numeric_limits<double>::max());
    }
  }
}

}  // namespace kds::test
