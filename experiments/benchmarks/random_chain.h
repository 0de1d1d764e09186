#pragma once
// Chains of touching beads of radius 1 that avoid themselves, and how they move.

#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <unordered_map>
#include <vector>

#include "motions/bezier_motion.h"

namespace kds::bench {

using Random = std::mt19937_64;
using Point = std::array<double, 3>;

inline Point random_direction(Random& random) {
  std::normal_distribution<double> normal;
  Point d{normal(random), normal(random), normal(random)};
  const double length = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
  for (double& x : d) x /= length;
  return d;
}

/// In a cube of which the beads fill a fifth.
inline std::vector<Point> random_chain(Random& random, std::size_t beads) {
  const double side = std::cbrt(static_cast<double>(beads) * 4.18879 / 0.2);
  std::unordered_map<std::int64_t, std::vector<std::size_t>> grid;  // of cells of side 2
  std::vector<Point> chain{{side / 2, side / 2, side / 2}};
  const auto cell = [](const Point& p, int x, int y, int z) {
    const auto place = [](double at, int shift) { return static_cast<std::int64_t>(at / 2) + shift + 1; };
    return (place(p[0], x) << 40) + (place(p[1], y) << 20) + place(p[2], z);
  };
  const auto is_free = [&](const Point& p) {
    for (const double x : p) {
      if (x < 0 || x > side) return false;
    }
    for (int near = 0; near < 27; ++near) {
      const auto found = grid.find(cell(p, near % 3 - 1, near / 3 % 3 - 1, near / 9 - 1));
      if (found == grid.end()) continue;
      for (const std::size_t other : found->second) {
        double distance = 0;
        for (std::size_t axis = 0; axis < 3; ++axis) distance += std::pow(p[axis] - chain[other][axis], 2);
        if (other + 1 < chain.size() && distance < 4) return false;
      }
    }
    return true;
  };
  grid[cell(chain[0], 0, 0, 0)].push_back(0);
  while (chain.size() < beads) {
    Point next{};
    int tries = 200;
    do {
      next = random_direction(random);
      for (std::size_t axis = 0; axis < 3; ++axis) next[axis] = chain.back()[axis] + 2 * next[axis];
    } while (--tries > 0 && !is_free(next));
    if (tries > 0) {
      grid[cell(next, 0, 0, 0)].push_back(chain.size());
      chain.push_back(next);
      continue;
    }
    for (int back = 0; back < 30 && chain.size() > 1; ++back) {  // a dead end
      grid[cell(chain.back(), 0, 0, 0)].pop_back();
      chain.pop_back();
    }
  }
  return chain;
}

/// Every bead moves this far in a direction of its own; the velocities at both ends (Hermite) differ from
/// that by as much.
template <Motion M>
M jostled(const std::vector<Point>& beads, double distance, Random& random) {
  static_assert(M::degree == 1 || M::degree == 3);
  M motion(beads.size());
  for (BeadId b = 0; b < beads.size(); ++b) {
    const Point step = random_direction(random);
    const Point first = random_direction(random);
    const Point last = random_direction(random);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double start = beads[b][axis];
      const double end = start + distance * step[axis];
      const int i = static_cast<int>(axis);
      motion.set_coordinate(b, 0, i, start);
      motion.set_coordinate(b, M::degree, i, end);
      if constexpr (M::degree == 3) {
        motion.set_coordinate(b, 1, i, start + distance * (step[axis] + first[axis]) / 3);
        motion.set_coordinate(b, 2, i, end - distance * (step[axis] + last[axis]) / 3);
      }
    }
    for (int k = 0; k <= M::degree; ++k) motion.set_weight(b, k, 1);
  }
  return motion;
}

}  // namespace kds::bench
