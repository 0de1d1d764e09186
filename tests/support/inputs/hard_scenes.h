#pragma once
// Small scenes that are difficult for exact arithmetic.

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "motions/scene/scene.h"
#include "tests/support/inputs/polynomials.h"

namespace kds::test {

/// Returns a number such as 7.25 or -3.5, times a power of ten.
inline double decimal(Random& random, int exponent) {
  const double mantissa = std::uniform_real_distribution<double>(-9.99, 9.99)(random);
  return std::strtod((std::to_string(mantissa) + "e" + std::to_string(exponent)).c_str(), nullptr);
}

/// Makes 4 to 8 points in the plane or in space, with or without weights, of degree 1 to 10.
/// Control points range from 10^-300 to 10^300. In some scenes most numbers have one of three sizes and a
/// quarter of the numbers are zero; in others only one number is large. Every fifth coordinate is at rest:
/// its true degree is 0, although it is written with the full degree.
inline Instance wild_instance(std::uint64_t seed) {
  Random random(seed);
  Instance instance;
  instance.file = "wild scene of seed " + std::to_string(seed);
  const bool in_space = random() % 2 != 0, weighted = in_space && random() % 4 != 0;
  instance.columns = weighted ? 4 : in_space ? 3 : 2;
  instance.degree = pick(random, 1, 10);
  const int points = pick(random, in_space ? 5 : 4, 8);
  const int one = pick(random, -300, 300), other = pick(random, -300, 300);
  const int low = std::min(one, other), high = std::max(one, other);
  enum Style { spread, three_sizes, with_zeros, one_large };
  const auto style = static_cast<Style>(pick(random, 0, 3));
  const auto number = [&](double share) -> double {
    if (style == with_zeros && random() % 4 == 0) return 0;
    const int sizes[] = {low, 0, high};
    const int exponent = style == three_sizes ? sizes[random() % 3]
                         : style == one_large ? 0
                                              : pick(random, low, high);
    return decimal(random, static_cast<int>(exponent * share));
  };
  for (int point = 0; point < points; ++point) {
    for (int column = 0; column < instance.columns; ++column) {
      const bool weight = column == 3, none = weight && random() % 2 != 0, rests = random() % 5 == 0;
      double x = 0;
      for (int k = 0; k <= instance.degree; ++k) {
        if (k == 0 || !rests) x = none ? 0 : weight ? std::abs(number(0.5)) : number(1);
        instance.control_points.push_back(x);
      }
    }
  }
  if (style == one_large) {
    const std::size_t rows = instance.control_points.size() / static_cast<std::size_t>(instance.columns);
    instance.control_points[static_cast<std::size_t>(instance.columns) * (random() % rows)] =
        decimal(random, 300);
  }
  return instance;
}

/// A scene of 5 to 16 balls with a few different radii in 2 to 4 frames. Coordinates are -1, 0 and 1, or
/// slightly larger. Many balls coincide, contain each other, rest, or change places at the same time.
struct LatticeBalls {
  Trajectory necklace;
  std::vector<double> radii;
};
inline LatticeBalls lattice_balls(std::uint64_t seed) {
  Random random(seed);
  LatticeBalls lattice;
  lattice.necklace.file = "lattice balls of seed " + std::to_string(seed);
  const int beads = pick(random, 5, 16), frames = pick(random, 2, 4), reach = pick(random, 1, 2);
  for (int frame = 0; frame < frames; ++frame) {
    Eigen::Matrix3Xd& positions = lattice.necklace.frames.emplace_back(3, beads);
    for (int bead = 0; bead < beads; ++bead) {
      const bool rests = frame > 0 && random() % 4 == 0, joins = bead > 0 && random() % 6 == 0;
      for (int axis = 0; axis < 3; ++axis)
        positions(axis, bead) = rests
                                    ? lattice.necklace.frames[static_cast<std::size_t>(frame) - 1](axis, bead)
                                : joins ? positions(axis, bead - 1)
                                        : pick(random, -reach, reach);
    }
  }
  const int sizes = pick(random, 2, 4);
  for (int bead = 0; bead < beads; ++bead) lattice.radii.push_back(0.25 * pick(random, 1, sizes));
  return lattice;
}

}  // namespace kds::test
