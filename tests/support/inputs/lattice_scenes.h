#pragma once
// Random scenes full of ties. Beads have whole coordinates; they meet, cross a face or an edge of the hull
// together, or all pass through one point, line or plane at the same time.

#include <algorithm>
#include <array>
#include <random>
#include <vector>

#include "motions/curves/bezier_motion.h"

namespace kds::test {

enum class LatticeScene {
  random,     ///< all control points are lattice points
  crossing,   ///< a simplex rests, and all other beads pass through one of its lattice points together
  collapse,   ///< all beads pass through a point, line or plane at u = 1/2
  from_flat,  ///< all beads start in one point, line or plane
  into_flat,  ///< all beads end in one point, line or plane
  winding,    ///< variations of scenes in which beads cross the hull together so that it winds around twice
};
inline constexpr int lattice_scene_kinds = 6;

namespace detail {

/// Returns a random whole number in [low, high].
inline int whole_number(std::mt19937& random, int low, int high) {
  return low + static_cast<int>(random() % static_cast<unsigned>(high - low + 1));
}

/// Scenes in which every facet is locally convex although the hull winds around twice. A bead has the start
/// and end of each coordinate, and a weight.
struct WindingBead {
  std::array<int, 3> from, to;
  int weight;
};
inline constexpr std::array<std::array<WindingBead, 6>, 2> winding_in_space{{{{{{1, 0, 0}, {1, 1, 0}, 0},
                                                                               {{1, 1, 1}, {0, 0, 2}, 0},
                                                                               {{2, 0, 1}, {0, 1, 1}, 0},
                                                                               {{1, 2, 2}, {1, 2, 2}, 0},
                                                                               {{2, 1, 0}, {1, 0, 2}, 0},
                                                                               {{2, 0, 2}, {0, 1, 2}, 0}}},
                                                                             {{{{0, 1, 3}, {0, 0, 0}, 0},
                                                                               {{0, 0, 2}, {1, 2, 0}, 0},
                                                                               {{1, 1, 1}, {1, 1, 1}, 0},
                                                                               {{0, 1, 1}, {0, 1, 1}, 0},
                                                                               {{2, 3, 0}, {1, 1, 0}, 0},
                                                                               {{3, 3, 3}, {3, 3, 3}, 0}}}}};
inline constexpr std::array<std::array<WindingBead, 6>, 1> winding_in_plane{{{{{{16, 0, 0}, {16, 0, 0}, 0},
                                                                               {{8, 0, 0}, {8, 0, 0}, 0},
                                                                               {{0, 0, 0}, {10, 10, 0}, 0},
                                                                               {{8, 8, 0}, {13, 3, 0}, 0},
                                                                               {{8, 16, 0}, {8, 16, 0}, 0},
                                                                               {{0, 8, 0}, {10, 8, 0}, 4}}}}};

/// Returns the control values of (2u-1)^Degree, u^Degree or (1-u)^Degree, which vanish in the middle, at the
/// start or at the end.
template <int Degree>
std::array<int, Degree + 1> vanishing(LatticeScene kind) {
  std::array<int, Degree + 1> values{};
  if (kind == LatticeScene::from_flat) {
    values[Degree] = 1;
  } else if (kind == LatticeScene::into_flat) {
    values[0] = 1;
  } else {
    for (int k = 0; k <= Degree; ++k) values[static_cast<std::size_t>(k)] = (Degree - k) % 2 == 0 ? 1 : -1;
  }
  return values;
}

}  // namespace detail

/// Varies one of the scenes above: permutes the beads, may add beads, changes some coordinates, applies a
/// shear, and raises the degree.
template <int Dimension, int Degree>
BezierMotion<Dimension, Degree> winding_scene(std::mt19937& random) {
  using detail::whole_number;
  std::vector<detail::WindingBead> beads;
  if constexpr (Dimension == 3) {
    const auto& scene = detail::winding_in_space[random() % detail::winding_in_space.size()];
    beads.assign(scene.begin(), scene.end());
  } else {
    beads.assign(detail::winding_in_plane[0].begin(), detail::winding_in_plane[0].end());
  }
  for (int changes = whole_number(random, 0, 2); changes > 0; --changes) {
    auto& bead = beads[random() % beads.size()];
    (random() % 2 == 0 ? bead.from : bead.to)[random() % Dimension] += whole_number(random, -1, 1);
  }
  for (int more = whole_number(random, 0, 2); more > 0; --more) {
    detail::WindingBead bead{};
    for (std::size_t axis = 0; axis < Dimension; ++axis) {
      bead.from[axis] = whole_number(random, 0, 3);
      bead.to[axis] = whole_number(random, 0, 3);
    }
    beads.push_back(bead);
  }
  const std::size_t axis = random() % Dimension, other = (axis + 1) % Dimension;
  const int shear = Dimension == 3 ? whole_number(random, -1, 1) : 0;
  std::shuffle(beads.begin(), beads.end(), random);
  BezierMotion<Dimension, Degree> motion(beads.size());
  constexpr int scale = 6;  // with this factor thirds and halves are whole
  for (BeadId b = 0; b < beads.size(); ++b) {
    auto& bead = beads[b];
    bead.from[axis] += shear * bead.from[other];
    bead.to[axis] += shear * bead.to[other];
    for (int k = 0; k <= Degree; ++k) {
      for (int a = 0; a < Dimension; ++a) {
        const auto at = static_cast<std::size_t>(a);
        motion.set_coordinate(b, k, a, scale / Degree * ((Degree - k) * bead.from[at] + k * bead.to[at]));
      }
      motion.set_weight(b, k, scale * scale * bead.weight);
    }
  }
  return motion;
}

/// Makes one step of at least Dimension + 1 beads. Half of the scenes have weights; in a quarter the weights
/// change in time.
template <int Dimension, int Degree>
BezierMotion<Dimension, Degree> lattice_scene(std::mt19937& random, LatticeScene kind) {
  using detail::whole_number;
  if (kind == LatticeScene::winding) return winding_scene<Dimension, Degree>(random);
  const int beads = whole_number(random, Dimension + 1, Dimension + 7);
  const int range = whole_number(random, 1, 4);
  const int flat_axes = whole_number(random, 1, Dimension);  // axes along which all beads meet
  const auto value_at = detail::vanishing<Degree>(kind);
  BezierMotion<Dimension, Degree> motion(static_cast<std::size_t>(beads));
  std::array<int, Dimension> meeting{};
  for (int& x : meeting) x = whole_number(random, 0, range);
  for (int b = 0; b < beads; ++b) {
    const auto bead = static_cast<BeadId>(b);
    const bool in_simplex = kind == LatticeScene::crossing && b <= Dimension;
    const bool crosses = kind == LatticeScene::crossing && !in_simplex && whole_number(random, 0, 3) > 0;
    for (int axis = 0; axis < Dimension; ++axis) {
      const int rest = in_simplex ? (b == axis + 1 ? range : 0) : whole_number(random, 0, range);
      const int across = whole_number(random, -range, range);
      const bool meets = kind != LatticeScene::crossing && axis < flat_axes;
      for (int k = 0; k <= Degree; ++k) {
        int x = rest;
        if (kind == LatticeScene::random) {
          x = whole_number(random, 0, range);
        } else if (crosses || meets) {
          x = (crosses ? meeting[static_cast<std::size_t>(axis)] : 0) +
              across * value_at[static_cast<std::size_t>(k)];
        } else if (!in_simplex && k == Degree && across > 0) {
          x = whole_number(random, 0, range);
        }
        motion.set_coordinate(bead, k, axis, x);
      }
    }
  }
  const int weights = whole_number(random, 0, 3);
  for (int b = 0; b < beads; ++b) {
    const int weight = whole_number(random, 0, range);
    for (int k = 0; k <= Degree; ++k)
      motion.set_weight(static_cast<BeadId>(b), k,
                        weights < 2    ? 0
                        : weights == 2 ? weight
                                       : whole_number(random, 0, range));
  }
  return motion;
}

}  // namespace kds::test
